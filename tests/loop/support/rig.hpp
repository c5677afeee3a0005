// The firmware on a simulated board that is as rough as a real one: noise, quantisation, an
// averaging current sense, a heater whose resistance tells its temperature.
#pragma once

#include <array>
#include <cmath>
#include <functional>

#include "loop/executive.hpp"
#include "simulated_board/simulated_board.hpp"

namespace supercoil::test {

/// What the tested muscle is asked for, by time since boot.
enum class Task { nothing, position, power, identify, calibrate };

struct RigSettings {
  host_sim::SimulatedBoardSettings board;
  BoardSettings firmware;
};

/// Two channels; places of controllers: 0 pi, 1 pd_ff, 2 mrac. Settings that depend on the rate are
/// set for it.
RigSettings rough_board(double rate_Hz = 1000.0);

/// The same with both muscles at one joint, the tested one its agonist; place 0 is learned_ff. The
/// muscles differ by 20 % in heat transfer and force.
RigSettings joint_board(double rate_Hz = 1000.0);

/// Channel 0 is under test; whatever does not name the neighbour is about channel 0.
class Rig {
 public:
  static constexpr std::uint8_t tested = 0;
  static constexpr std::uint8_t neighbour = 1;

  explicit Rig(const RigSettings& settings);
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  /// One tick: commands what the task asks for, then runs the firmware.
  void tick();
  void run(double time_s);
  void run_ticks(int ticks);
  /// Runs until the condition holds; false when it does not within max_s.
  bool run_until(const std::function<bool()>& holds, double max_s);

  /// Boots and passes the self-test; then arms (which probes); then heats.
  void boot();
  void arm();
  void heat(Task new_task);
  /// The neighbour of a booted rig is armed and follows a position of its own from now on.
  void start_neighbour();

  void send(Verb verb, double value = 0.0) { loop.send({tested, verb, value}); }
  /// Sends it, and runs the tick that answers. Not for a rig with a task, which sends by itself.
  Refusal answer_to(Verb verb, double value = 0.0);
  /// The same for either channel.
  Refusal answer_of(std::uint8_t channel, Verb verb, double value = 0.0);
  /// Holds this power for this time; renews the command before it expires.
  void hold_power(double power_W, double time_s);
  State state() const { return loop.channel(tested).state().state(); }
  Fault fault() const { return loop.channel(tested).state().first_cause(); }
  const Snapshot& snapshot() const { return loop.channel(tested).snapshot(); }
  host_sim::MuscleChannel& muscle() { return board.channel(tested); }
  double time_s() const { return hal::seconds(board.true_time()); }
  double period_s() const { return period_s_; }
  /// Of the last command that was not obeyed, except those to the neighbour.
  Refusal last_refusal = Refusal::none;
  double last_nearest = NAN;              ///< the nearest value in that answer
  std::array<Refusal, 2> last_answers{};  ///< to the last command to each channel
  /// The answer to the tested channel's last reset.
  Refusal answer_to_reset = Refusal::none;

  host_sim::SimulatedBoard board;
  Loop loop;
  Executive executive;
  Task task = Task::nothing;
  double scale = 1.0;         ///< of everything that the tested muscle is asked for
  bool commands_flow = true;  ///< to the tested channel
  bool telemetry_lives = true;
  std::function<void()> before_tick = [] {};  ///< persistent faults
  bool interval_missed = false;               ///< a muscle's temperature left the firmware's bounds

 private:
  void send_task_command();
  void send_neighbour_command();
  void watch_heat();
  double period_s_;
  double ambient_C_;
  bool neighbour_follows_ = false;
  std::uint32_t beats_ = 0;
};

}  // namespace supercoil::test
