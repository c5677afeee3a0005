// Manual control of one muscle: commands, and renewals while somebody watches.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "supercoil/hal/error.hpp"

#include "apps/supercoil/bus/commander.hpp"

namespace supercoil::operating {

/// Commands to heat are renewed every 50 ms while a page keeps reporting that it is alive. When no
/// page has for page_timeout, renewals stop, and the board lets the command expire. Safe from any
/// thread; a separate thread talks to the node.
class ManualControl {
 public:
  using Answer = Result<Refusal>;
  using OpenBus = std::function<Result<std::unique_ptr<hal::CanBus>>()>;
  static constexpr auto page_timeout = std::chrono::milliseconds(1500);

  ManualControl(std::uint8_t node, OpenBus open_bus);
  ManualControl(const ManualControl&) = delete;
  ManualControl& operator=(const ManualControl&) = delete;
  ~ManualControl();

  /// Waits for the board's answer. Requests are served one at a time.
  Answer ask(Verb verb, double value);
  /// Like ask(): prepares a value of a controller.
  Answer prepare(const can_client::TunedPlace& place, double value);
  /// One knot of a trajectory, this long after the previous one.
  struct NextKnot {
    double after_s;
    double position_m;
    double velocity_m_per_s;
  };
  /// The result of sending some knots.
  struct Sent {
    std::size_t knots;          ///< number of knots that were taken
    can_client::Played played;  ///< the answer to the last knot that was sent
  };
  /// Sends knots, up to the first one that is refused, and starts the trajectory if `start`. With
  /// neither it asks for the playback. Knots are only sent while a command is held; releasing it
  /// ends sending between two knots. Sending knots counts as being alive.
  Result<Sent> play(const std::vector<NextKnot>& knots, bool start);
  struct Holding {
    bool holding;
    std::string reason;  ///< why nothing is held, since the last held command
  };
  /// Reports that a heating page is alive.
  Holding alive();
  /// Stops renewing. Does not wait for the board.
  void release_hold(const std::string& reason);

 private:
  using Clock = std::chrono::steady_clock;
  using Act = std::function<Answer()>;
  struct PendingCommand {
    Act act;  ///< runs in the thread
    std::promise<Answer> answer;
  };

  Answer wait_for(Act act);
  void run();
  Answer execute(Verb verb, double value);
  Answer send_knots(const std::vector<NextKnot>& knots, bool start, Sent& sent);
  void renew();
  Answer with_commander(const std::function<Answer(Commander&)>& act);
  Answer command(Verb verb, double value);
  bool holds() const;

  std::uint8_t node_;
  OpenBus open_bus_;
  std::unique_ptr<Commander> commander_;  ///< used by the thread
  std::mutex request_mutex_;              ///< held while a request waits
  mutable std::mutex mutex_;
  std::condition_variable woken_;
  std::optional<PendingCommand> pending_;
  bool ending_ = false;
  bool holding_ = false;
  std::string reason_ = "nothing is held";
  Clock::time_point alive_{};
  std::thread thread_;
};

}  // namespace supercoil::operating
