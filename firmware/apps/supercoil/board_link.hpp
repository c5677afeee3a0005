// Where commands are sent: the supercoild of this board, or nodes on a CAN bus.
#pragma once

#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "supercoil/hal/error.hpp"

#include "apps/supercoil/board_socket.hpp"
#include "apps/supercoil/bus/commander.hpp"
#include "apps/supercoil/bus/recent.hpp"
#include "board/learned.hpp"
#include "loop/known_muscle.hpp"
#include "loop/tuner.hpp"

namespace supercoil::operating {

class BoardLink {
 public:
  using Answer = Result<std::string>;

  BoardLink() = default;
  BoardLink(const BoardLink&) = delete;
  BoardLink& operator=(const BoardLink&) = delete;
  virtual ~BoardLink() = default;

  /// "1 arm": "ok", "refused: why", or what is wrong with the line. The error: no answer.
  virtual Answer ask(const std::string& line) = 0;
  /// " --can can0" or " --socket PATH", the option that addresses it; empty: none is needed.
  virtual std::string words() const { return ""; }
  /// The known state of the board, in lines.
  virtual Answer state() = 0;
  /// The same as one JSON object.
  virtual Answer state_json() = 0;
  /// A channel's present status. channel: as in a line.
  struct Status {
    std::string state;
    std::string fault;     ///< "none", or its first cause
    bool probing = false;  ///< its heater is being measured
  };
  virtual Result<Status> status(const std::string& channel) = 0;
  /// How identify or calibrate ended: the names of a ModeResult and of IdentifyNotes.
  struct Ending {
    std::string result;
    std::string notes;  ///< "theta2_uncertain,poor_fit"; empty: none
  };
  /// channel: as in a line.
  virtual Result<Ending> ending(const std::string& channel) = 0;
  /// The result of a comparison with a meter, without its date. channel: as in a line.
  virtual Result<board::SenseComparison> senses(const std::string& channel) = 0;
  /// The muscle that the board uses, in the order of known_quantities. channel: as in a line.
  virtual Result<KnownMuscle> muscle(const std::string& channel) = 0;
  /// One value of a controller; NaN: it has none. channel: as in a line.
  virtual Result<double> tuning(const std::string& channel, int place, std::size_t tunable,
                                TuningSet set) = 0;
  /// Prepares one value, or a set: then name is "all" and value the set's. Answers as ask().
  virtual Answer prepare(const std::string& channel, int place, const std::string& name,
                         const std::string& value) = 0;
  /// The newest position less reference model; NaN while no position is followed.
  virtual Result<double> error_m(const std::string& channel) = 0;
  /// The newest position, from rest; NaN: the sensor has no value.
  virtual Result<double> position_m(const std::string& channel) = 0;
  /// The newest progress of identify or calibrate, 0 to 1; NaN while it is not known.
  virtual Result<double> progress(const std::string& channel) = 0;
  /// Lets the board go on.
  virtual void wait(std::chrono::milliseconds time) { std::this_thread::sleep_for(time); }
  /// From an arbitrary origin; runs with the board's time.
  virtual double time_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }
};

class LocalBoardLink final : public BoardLink {
 public:
  explicit LocalBoardLink(BoardSocket socket, std::string path = default_socket)
      : socket_(std::move(socket)), path_(std::move(path)) {}
  std::string words() const override { return socket_words(path_); }
  Answer ask(const std::string& line) override;
  Answer state() override { return socket_.ask("state"); }
  Answer state_json() override;
  Result<Status> status(const std::string& channel) override;
  Result<Ending> ending(const std::string& channel) override;
  Result<board::SenseComparison> senses(const std::string& channel) override;
  Result<KnownMuscle> muscle(const std::string& channel) override;
  Result<double> tuning(const std::string& channel, int place, std::size_t tunable,
                        TuningSet set) override;
  Answer prepare(const std::string& channel, int place, const std::string& name,
                 const std::string& value) override;
  Result<double> error_m(const std::string& channel) override;
  Result<double> position_m(const std::string& channel) override;
  Result<double> progress(const std::string& channel) override;

 private:
  /// A channel's line from the answer for all channels. The error has the code invalid_argument for
  /// a channel that the board does not have.
  Answer line_of(const std::string& request, const std::string& channel);

  BoardSocket socket_;
  std::string path_;
};

/// The first number of a line is a node. Leases are given back at the end.
class CanBoardLink final : public BoardLink {
 public:
  explicit CanBoardLink(std::string bus) : bus_(std::move(bus)) {}
  ~CanBoardLink() override;
  std::string words() const override { return " --can " + bus_; }
  Answer ask(const std::string& line) override;
  /// Listens for a second and a half.
  Answer state() override;
  Answer state_json() override;
  /// From the next heartbeat.
  Result<Status> status(const std::string& channel) override;
  /// From the next heartbeat; notes from the next estimates, if the board sends any.
  Result<Ending> ending(const std::string& channel) override;
  Result<board::SenseComparison> senses(const std::string& channel) override;
  Result<KnownMuscle> muscle(const std::string& channel) override;
  Result<double> tuning(const std::string& channel, int place, std::size_t tunable,
                        TuningSet set) override;
  Answer prepare(const std::string& channel, int place, const std::string& name,
                 const std::string& value) override;
  Result<double> error_m(const std::string& channel) override;
  Result<double> position_m(const std::string& channel) override;
  Result<double> progress(const std::string& channel) override;

 private:
  /// The newest values that a node sends unasked.
  struct Received {
    std::unique_ptr<hal::CanBus> bus;
    double error_m = NAN;
    double position_m = NAN;
    double progress = NAN;
  };
  Result<Received*> receive(const std::string& channel);
  Result<Commander*> commander(std::uint8_t node);
  /// The kinds of the active controllers by node; omits nodes that do not report them.
  std::map<int, std::string> controller_kinds(const FrameHistory& frame_history);
  /// Listens for a while and returns describe() of the frames received.
  Answer collect_frames(const std::function<std::string(const FrameHistory&)>& describe);

  std::string bus_;
  std::map<std::uint8_t, std::unique_ptr<Commander>> nodes_;
  std::map<std::uint8_t, Received> received_;
};

/// Arms a channel and waits until its heater is measured: until then heating is refused.
/// "ok", "refused: why", or "fault heater_open; see faults/heater_open in ...". The error: no
/// answer.
BoardLink::Answer arm(BoardLink& board, const std::string& channel);

/// "fault heater_open; docs/faults/heater_open.md; when its cause is gone: supercoil command 1
/// reset --can can0". Empty: it has none, or does not answer.
std::string present_fault(BoardLink& board, const std::string& channel);
/// The error with that appended.
std::string with_present_fault(const std::string& error, BoardLink& board,
                               const std::string& channel);

/// What interrupted identify or calibrate, if nothing came after it: "fault heater_open;
/// docs/faults/heater_open.md", "disarmed" or "by another command". The error: no answer.
BoardLink::Answer interruption(BoardLink& board, const std::string& channel);

struct ChannelEnding {
  std::string channel;  ///< as in a line
  BoardLink::Ending ending;
};
/// How identify or calibrate of a channel ended, once the board reports it. For the agonist of a
/// joint both go on with the antagonist, which is then the second one.
Result<std::vector<ChannelEnding>> endings(BoardLink& board, const std::string& channel);

/// can: a bus by its name; empty: the supercoild that listens at this socket.
Result<std::unique_ptr<BoardLink>> open_link(const std::string& can, const std::string& socket);

}  // namespace supercoil::operating
