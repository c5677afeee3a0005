// The firmware on a simulated board that is as rough as a real one: noise, quantisation, an
// averaging current sense, a heater whose resistance tells its temperature.
#pragma once

#include <cmath>
#include <functional>

#include "loop/executive.hpp"
#include "simulated_board/simulated_board.hpp"

namespace supercoil::test {

/// What the muscle is asked for, by time since boot.
enum class Task { nothing, position, power, identify, calibrate };

struct RigSettings {
  host_sim::SimulatedBoardSettings board;
  BoardSettings firmware;
};

/// One channel; places of controllers: 0 pi, 1 pd_ff, 2 mrac.
RigSettings rough_board();

class Rig {
 public:
  explicit Rig(const RigSettings& settings);
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  /// One tick: what is asked for, then the firmware.
  void tick();
  void run(double time_s);
  /// Until it holds; false when that takes longer than most_s.
  bool run_until(const std::function<bool()>& holds, double most_s);

  /// Boots and passes the self-test; then arms (which probes); then heats.
  void boot();
  void arm();
  void heat(Task new_task);

  void send(Verb verb, double value = 0.0) { loop.send({0, verb, value}); }
  State state() const { return loop.channel(0).state().state(); }
  Fault fault() const { return loop.channel(0).state().first_cause(); }
  const Snapshot& snapshot() const { return loop.channel(0).snapshot(); }
  double time_s() const { return hal::seconds(board.true_time()); }
  host_sim::MuscleChannel& muscle() { return board.channel(0); }
  /// What the resetting operator and the last answers were.
  Refusal last_refusal = Refusal::none;

  host_sim::SimulatedBoard board;
  Loop loop;
  Executive executive;
  Task task = Task::nothing;
  double scale = 1.0;  ///< of everything that is asked for
  bool commands_flow = true;
  bool telemetry_lives = true;
  std::function<void()> before_tick = [] {};  ///< troubles that go on
  bool interval_missed = false;  ///< the plant's temperature left the firmware's bounds
  double hottest_C = 0.0;        ///< of the plant

 private:
  void ask();
  double ambient_C_;
  std::uint32_t beats_ = 0;
};

}  // namespace supercoil::test
