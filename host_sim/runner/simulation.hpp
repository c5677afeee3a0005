// One scenario, tick by tick: the firmware over the simulated board.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "loop/executive.hpp"
#include "recorder/flight_recorder.hpp"
#include "runner/first_motion.hpp"
#include "runner/reference_demand.hpp"
#include "scenario/scenario.hpp"
#include "simulated_board/simulated_board.hpp"
#include "simulated_board/simulated_can_bus.hpp"
#include "supervisor/detectors/margin.hpp"
#include "telemetry/can_endpoint.hpp"

namespace supercoil::host_sim {

/// Of a joint's antagonist, as TickRecord's of the muscle.
struct AntagonistRecord {
  double applied_power_W = 0.0;
  double temperature_rise_K = 0.0;
  double coldest_K = 0.0;
  double hottest_K = 0.0;
  LimitedBy limited_by = LimitedBy::nothing;
};

/// Of all muscles of a bundle; rises as TickRecord's.
struct BundleRecord {
  double min_temperature_rise_K = 0.0;
  double max_temperature_rise_K = 0.0;
  double hottest_K = 0.0;  ///< the highest of the firmware's bounds
  bool outside = false;    ///< one of them is not within its bounds
};

/// What there is to see of one tick: the firmware's snapshot, and the truth beside it. Powers act
/// from this tick to the next.
struct TickRecord {
  double time_s = 0.0;
  double reference = 0.0;  ///< metres, or watts in open loop
  double model_m = 0.0;    ///< where the reference model is
  double position_m = 0.0;
  double measured_m = 0.0;
  double power_W = 0.0;          ///< as the controller wanted it
  double applied_power_W = 0.0;  ///< after limits, PWM and delay
  double temperature_rise_K = 0.0;
  double thermometer_C = NAN;  ///< NaN: no thermometer
  double coldest_K = 0.0;      ///< above the air: the firmware's bounds for it
  double hottest_K = 0.0;
  bool limited = false;
  double oscillation_period_s = 0.0;  ///< that the controller saw its loop have; 0: none
  bool open_loop = false;             ///< no reference model is followed
  bool commands_power = false;        ///< the reference is a power
  State state = State::disarmed;
  Fault fault = Fault::none;  ///< the channel's first cause
  /// Of that first cause: NaN where no detector measures it.
  detectors::Margin fault_margin{.measured = NAN, .limit = NAN};
  Fault board_fault = Fault::none;  ///< the board's, which may come after it
  LimitedBy limited_by = LimitedBy::nothing;
  /// Beyond which limit the reference alone goes, whatever the loop does.
  LimitedBy reference_limited_by = LimitedBy::nothing;
  double clipped_power_W = 0.0;                ///< power_W, within the range of power
  std::optional<AntagonistRecord> antagonist;  ///< where there is a joint
  std::optional<BundleRecord> bundle;          ///< where there is one
};

inline constexpr double temperature_rounding_K = 1e-9;
/// Whether a temperature is not within the firmware's bounds for it.
constexpr bool is_outside(double rise_K, double coldest_K, double hottest_K) {
  return !(rise_K >= coldest_K - temperature_rounding_K &&
           rise_K <= hottest_K + temperature_rounding_K);
}

/// After boot, and again where arming had to wait. It probes the heater, which moves the muscle by
/// some 40 µm; after so long it is at rest.
inline constexpr double boot_s = 15.0;

/// Boots the firmware, lets it arm, and commands it as the scenario says. The same scenario gives
/// the same records, to the bit.
class Simulation {
 public:
  /// The boot is over when the scenario begins: the muscle is armed, cold and at rest.
  explicit Simulation(const Scenario& scenario);
  explicit Simulation(Scenario&&) = delete;  // it would be gone
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  bool done() const { return tick_ >= ticks_; }
  /// One tick: events, what is asked for, and the firmware's tick. What is returned lasts until the
  /// next.
  const TickRecord& step();
  /// One tick as well, with a command beside the scenario's, and what the board answers to it.
  Answer command(Verb verb, double value, std::uint8_t channel = 0);

  std::int64_t tick() const { return tick_; }
  std::int64_t ticks() const { return ticks_; }
  /// Of the last step().
  double time_s() const { return static_cast<double>(tick_ - 1) * step_s_; }
  const Conditions& conditions() const { return *conditions_; }
  /// Empty when the scenario has no estimator.
  std::optional<control::Estimate> estimate() const { return loop_.channel(0).estimates(); }
  /// Of a scenario without a joint.
  const Plant& plant() const { return board_.channel(0).plant(); }
  /// Null without a joint.
  const JointPlant* joint() const {
    return scenario_->start.joint ? &board_.joint(0).plant() : nullptr;
  }
  /// The hottest that any of its muscles was.
  double peak_temperature_rise_K() const;
  Loop& loop() { return loop_; }
  /// Keeps what happens from now on; must outlive the simulation's steps.
  void record_to(recorder::FlightRecorder& recorder) { recorder_ = &recorder; }
  const Loop& loop() const { return loop_; }
  /// Called with a channel, and with what it learned, in the tick in which it did.
  using OnLearned = std::function<void(std::size_t channel, const board::LearnedUpdate&)>;
  void on_learned(OnLearned store) { on_learned_ = std::move(store); }
  /// Puts the board on a CAN bus from now on; the listener hears every frame that it sends.
  void join_bus(std::function<void(const hal::CanFrame&)> listener);
  /// Empty before join_bus().
  SimulatedCanBus* bus() { return bus_ ? &*bus_ : nullptr; }
  /// The board's clock at the scenario's time 0.
  hal::Time start() const { return start_; }
  /// What identify or calibrate found last of a channel's muscle, 1: a joint's antagonist's or a
  /// bundle's second; empty
  /// when nothing was.
  const std::optional<board::Learned>& learned(std::size_t channel = 0) const {
    return learned_[channel];
  }
  /// The last first motion; empty when none began.
  const std::optional<FirstMotionRun>& first_motion() const { return first_motion_; }

 private:
  void boot();
  void boot_for(double time_s);
  void apply_event(const Event& event);
  void set_air();
  void inject_faults(const InjectedFaults& faults);
  void change_joint(const Conditions& before);
  void change_companions();
  AntagonistRecord antagonist_record() const;
  BundleRecord bundle_record(const TickRecord& first) const;
  double rise_K(std::size_t channel) const;
  /// What is asked for at this tick, NaN: nothing. Begins a first motion when the muscle is armed.
  double reference_at(double time_s);
  void ask(double reference);
  void ask_for_rest();
  void send(Verb verb, double value = 0.0);
  void housekeep();
  void pass_rows();
  void record(double time_s, double reference);
  /// After a tick: beyond which limit the reference alone goes.
  LimitedBy reference_limited_by();

  const Scenario* scenario_;
  const Conditions* conditions_;
  std::int64_t ticks_;
  double step_s_;
  std::int64_t tick_ = 0;
  TickRecord record_;  ///< of the last step; only what changes is written
  std::size_t next_event_ = 0;
  std::size_t controllers_used_ = 0;
  std::size_t estimators_used_ = 0;
  OperatorAction last_action_ = OperatorAction::rest;
  bool resetting_ = false;
  std::uint32_t beats_ = 0;
  Answer answer_;  ///< to command()
  recorder::FlightRecorder* recorder_ = nullptr;
  SimulatedBoard board_;
  Loop loop_;
  Executive executive_;
  hal::Time start_{};
  std::optional<SimulatedCanBus> bus_;
  std::optional<telemetry::CanEndpoint> link_;
  LearnedMuscles learned_;
  OnLearned on_learned_;
  std::optional<FirstMotionRun> first_motion_;
  std::optional<ReferenceDemand> demand_;  ///< while a muscle without antagonist follows a position
};

}  // namespace supercoil::host_sim
