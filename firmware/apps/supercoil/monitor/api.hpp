// What the page asks the monitor for: its files, the bus's data, commands.
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

/// The hands on all nodes; each is made when it is first asked for. Safe from any thread.
class ManualControls {
 public:
  explicit ManualControls(std::function<ManualControl::OpenBus(std::uint8_t)> bus_of)
      : bus_of_(std::move(bus_of)) {}

  ManualControl& of(std::uint8_t node);
  /// All values of a node's controllers and estimators, over a connection of its own: this may take
  /// seconds.
  Result<TunedChannel> read_tuning(std::uint8_t node);
  /// Their kinds only, which is quick.
  Result<nlohmann::ordered_json> read_kinds(std::uint8_t node);
  /// What a node goes by, likewise.
  Result<KnownMuscle> read_muscle(std::uint8_t node);
  void release_hold(const std::string& reason);

 private:
  /// For one question after the other.
  Result<AskTuning> ask_tuning(std::uint8_t node);

  std::function<ManualControl::OpenBus(std::uint8_t)> bus_of_;
  std::mutex mutex_;
  std::map<std::uint8_t, std::unique_ptr<ManualControl>> controls_;
};

/// Handlers of one server. Nothing of it is copied; all outlives the server.
class Api {
 public:
  struct About {
    std::string source;  ///< as the user named it
    bool log = false;
    int stop_port = 0;   ///< 0: nothing can be commanded
    bool setup = false;  ///< it leads through setup as well
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
  /// read(node): what the board answers, as JSON. The node is in the address.
  template <class Read>
  void tell_of_node(const Request& request, Response& response, Read read);
  void tune(const Request& request, Response& response);
  struct Reader {
    std::uint64_t next = 0;  ///< frame
    bool begun = false;
    bool was_lost = false;
  };
  /// The frame with which it begins: where it left off, if its Last-Event-ID is of this run.
  std::uint64_t first_frame(const Request& request) const;
  std::string event_id(const Reader& reader) const;
  /// One piece of a stream; false: the reader is gone.
  bool stream_piece(httplib::DataSink& sink, Reader& reader);

  /// The page's threads are more, so that streams cannot take them all.
  static constexpr int max_streams = 24;

  Access access_;
  const FrameHistory* frame_history_;
  ManualControls* controls_;
  About about_;
  /// Numbers of frames are of one run.
  const std::string run_ =
      std::to_string(std::chrono::system_clock::now().time_since_epoch().count());
  std::atomic<bool> ending_{false};
  std::atomic<int> streams_{0};
};

}  // namespace supercoil::operating
