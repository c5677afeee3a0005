// What the monitor serves to the page: its files, the bus's data, commands.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "apps/supercoil/bus/recent.hpp"
#include "apps/supercoil/monitor/access.hpp"
#include "apps/supercoil/monitor/manual_control.hpp"
#include "apps/supercoil/tuning_table.hpp"
#include "loop/known_muscle.hpp"

namespace supercoil::operating {

/// Manual controls of all nodes, each created on first use. Safe from any thread.
class ManualControls {
 public:
  explicit ManualControls(std::function<ManualControl::OpenBus(std::uint8_t)> bus_of)
      : bus_of_(std::move(bus_of)) {}

  ManualControl& of(std::uint8_t node);
  /// All values of a node's controllers and estimators, over a separate connection: may take
  /// seconds.
  Result<TunedChannel> read_tuning(std::uint8_t node);
  /// Only their kinds, which is quick.
  Result<nlohmann::ordered_json> read_kinds(std::uint8_t node);
  /// The muscle that a node uses, also over a separate connection.
  Result<KnownMuscle> read_muscle(std::uint8_t node);
  void release_hold(const std::string& reason);

 private:
  /// For a series of questions.
  Result<ReadTunable> tunable_reader(std::uint8_t node);

  std::function<ManualControl::OpenBus(std::uint8_t)> bus_of_;
  std::mutex mutex_;
  std::map<std::uint8_t, std::unique_ptr<ManualControl>> controls_;
};

/// Handlers of one server. They refer to this object: it and its arguments outlive the server.
class Api {
 public:
  struct About {
    std::string source;  ///< as the user named it
    bool log = false;
    int stop_port = 0;   ///< 0: nothing can be commanded
    bool setup = false;  ///< it also offers setup
  };

  Api(Access access, const FrameHistory& frame_history, ManualControls& controls, About about);

  void serve_with(httplib::Server& server);
  /// Streams end within a second.
  void end() { ending_ = true; }

 private:
  using Request = httplib::Request;
  using Response = httplib::Response;

  void about(const Request& request, Response& response) const;
  void history(const Request& request, Response& response) const;
  void stream(const Request& request, Response& response);
  void command(const Request& request, Response& response);
  void play(const Request& request, Response& response);
  void alive(const Request& request, Response& response);
  /// read(node): the board's answer as JSON. The address contains the node.
  template <class Read>
  void answer_from_node(const Request& request, Response& response, Read read);
  void tune(const Request& request, Response& response);
  struct Reader {
    std::uint64_t next = 0;  ///< frame
    bool begun = false;
    bool was_lost = false;
  };
  /// The stream's first frame: where the client left off, if its Last-Event-ID is from this run.
  std::uint64_t first_frame(const Request& request) const;
  std::string event_id(const Reader& reader) const;
  /// Sends one piece of a stream; false: the client is gone.
  bool stream_piece(httplib::DataSink& sink, Reader& reader);

  /// The page has more threads than this, so that streams cannot take them all.
  static constexpr int max_streams = 24;

  Access access_;
  const FrameHistory* frame_history_;
  ManualControls* controls_;
  About about_;
  /// Frame numbers are only valid within one run.
  const std::string run_ =
      std::to_string(std::chrono::system_clock::now().time_since_epoch().count());
  std::atomic<bool> ending_{false};
  std::atomic<int> streams_{0};
};

}  // namespace supercoil::operating
