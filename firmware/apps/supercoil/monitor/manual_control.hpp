// Manual control of one muscle: commands, and renewals for as long as somebody watches.
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

/// What heats is renewed every 50 ms while a page says again and again that it is alive; when none
/// has for page_timeout, nothing is renewed any more, and the board lets the command expire.
/// Safe from any thread; a thread of its own talks to the node.
class ManualControl {
 public:
  using Answer = Result<Refusal>;
  using OpenBus = std::function<Result<std::unique_ptr<hal::CanBus>>()>;
  static constexpr auto page_timeout = std::chrono::milliseconds(1500);

  ManualControl(std::uint8_t node, OpenBus open_bus);
  ManualControl(const ManualControl&) = delete;
  ManualControl& operator=(const ManualControl&) = delete;
  ~ManualControl();

  /// Waits for the board's answer. One at a time; others wait for their turn.
  Answer ask(Verb verb, double value);
  /// Prepares a value of a controller, likewise.
  Answer prepare(const can_client::TunedPlace& place, double value);
  /// One knot of a trajectory, so long after the one before it.
  struct NextKnot {
    double after_s;
    double position_m;
    double velocity_m_per_s;
  };
  /// What became of some knots.
  struct Sent {
    std::size_t knots;          ///< so many were taken
    can_client::Played played;  ///< the answer to the last one that was sent
  };
  /// Sends knots, up to the first one that is refused, and starts the trajectory if told to.
  /// Without either it asks for the playback. Only what is held is played, and letting go ends it
  /// between two knots. Whoever sends knots is alive.
  Result<Sent> play(const std::vector<NextKnot>& knots, bool start);
  struct Holding {
    bool holding;
    std::string reason;  ///< why not, since the last command that was held
  };
  /// A page that heats lives.
  Holding alive();
  /// Nothing is renewed any more. Does not wait for the board.
  void release_hold(const std::string& reason);

 private:
  using Clock = std::chrono::steady_clock;
  using Act = std::function<Answer()>;
  struct PendingCommand {
    Act act;  ///< in the thread
    std::promise<Answer> answer;
  };

  Answer wait_for(Act act);
  void run();
  Answer obey(Verb verb, double value);
  Answer send_knots(const std::vector<NextKnot>& knots, bool start, Sent& sent);
  void renew();
  Answer with_commander(const std::function<Answer(Commander&)>& act);
  Answer command(Verb verb, double value);
  bool holds() const;

  std::uint8_t node_;
  OpenBus open_bus_;
  std::unique_ptr<Commander> commander_;  ///< of the thread
  std::mutex asking_;                     ///< of those who ask
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
