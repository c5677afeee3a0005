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

/// A joint's antagonist; fields as in TickRecord.
struct AntagonistRecord {
  double applied_power_W = 0.0;
  double temperature_rise_K = 0.0;
  double coldest_K = 0.0;
  double hottest_K = 0.0;
  LimitedBy limited_by = LimitedBy::nothing;
};

/// All muscles of a bundle; rises as in TickRecord.
struct BundleRecord {
  double min_temperature_rise_K = 0.0;
  double max_temperature_rise_K = 0.0;
  double hottest_K = 0.0;  ///< the highest of the firmware's bounds
  bool outside = false;    ///< one of them is not within its bounds
};

/// The observable state of one tick: the firmware's snapshot, and the true values. Powers act from
/// this tick to the next.
struct TickRecord {
  double time_s = 0.0;
  double reference = 0.0;  ///< metres, or watts in open loop
  double model_m = 0.0;    ///< where the reference model is
  double position_m = 0.0;
  double measured_m = 0.0;
  double power_W = 0.0;          ///< as demanded by the controller
  double applied_power_W = 0.0;  ///< after limits, PWM and delay
  double temperature_rise_K = 0.0;
  double thermometer_C = NAN;  ///< NaN: no thermometer
  double coldest_K = 0.0;      ///< above the air: the firmware's bounds for it
  double hottest_K = 0.0;
  bool limited = false;
  double oscillation_period_s = 0.0;  ///< of the loop, as the controller detected it; 0: none
  bool open_loop = false;             ///< no reference model is followed
  bool commands_power = false;        ///< the reference is a power
  State state = State::disarmed;
  Fault fault = Fault::none;  ///< the channel's first cause
  /// The margin of that first cause; NaN if no detector measures it.
  detectors::Margin fault_margin{.measured = NAN, .limit = NAN};
  Fault board_fault = Fault::none;  ///< the board's, which may come after it
  LimitedBy limited_by = LimitedBy::nothing;
  /// The limit that the reference alone exceeds, whatever the loop does.
  LimitedBy reference_limited_by = LimitedBy::nothing;
  double clipped_power_W = 0.0;                ///< power_W, clipped to the power range
  std::optional<AntagonistRecord> antagonist;  ///< where there is a joint
  std::optional<BundleRecord> bundle;          ///< where there is one
};

/// Of the hottest of its muscles.
inline double hottest_rise_K(const TickRecord& record) {
  if (record.bundle) return record.bundle->max_temperature_rise_K;
  if (!record.antagonist) return record.temperature_rise_K;
  return std::fmax(record.temperature_rise_K, record.antagonist->temperature_rise_K);
}

inline constexpr double temperature_rounding_K = 1e-9;
/// Below it the hot end is not judged: free convection dies away with the rise, so that a muscle
/// which is all but cold may cool slower than the bounds of its heat transfer say.
inline constexpr double negligible_rise_K = 0.01;
/// Whether a temperature is not within the firmware's bounds for it.
constexpr bool is_outside(double rise_K, double coldest_K, double hottest_K) {
  const double max_K = hottest_K < negligible_rise_K ? negligible_rise_K : hottest_K;
  return !(rise_K >= coldest_K - temperature_rounding_K &&
           rise_K <= max_K + temperature_rounding_K);
}

/// Wait after boot, and again after a delayed arming: the heater's probe moves the muscle by some
/// 40 µm, and after this time it is at rest.
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
  /// One tick: events, commands, and the firmware's tick. The returned record is valid until the
  /// next.
  const TickRecord& step();
  /// Also one tick, with one more command than the scenario's. Returns the board's answer.
  Answer command(Verb verb, double value, std::uint8_t channel = 0);

  std::int64_t tick() const { return tick_; }
  std::int64_t ticks() const { return ticks_; }
  /// Of the last step().
  double time_s() const { return static_cast<double>(tick_ - 1) * step_s_; }
  const Conditions& conditions() const { return *conditions_; }
  /// Empty when the scenario has no estimator.
  std::optional<control::Estimate> estimate() const { return loop_.channel(0).estimates(); }
  /// Only for a scenario without a joint.
  const Plant& plant() const { return board_.channel(0).plant(); }
  /// Null without a joint.
  const JointPlant* joint() const {
    return scenario_->start.joint ? &board_.joint(0).plant() : nullptr;
  }
  /// The highest rise so far of any of its muscles.
  double peak_temperature_rise_K() const;
  Loop& loop() { return loop_; }
  /// Records from now on; the recorder must outlive the simulation's steps.
  void record_to(recorder::FlightRecorder& recorder) { recorder_ = &recorder; }
  const Loop& loop() const { return loop_; }
  /// Called with a channel and what it learned, in the tick in which it learned it.
  using OnLearned = std::function<void(std::size_t channel, const board::LearnedUpdate&)>;
  void on_learned(OnLearned store) { on_learned_ = std::move(store); }
  /// Puts the board on a CAN bus from now on; the listener hears every frame that it sends.
  void join_bus(std::function<void(const hal::CanFrame&)> listener);
  /// Empty before join_bus().
  SimulatedCanBus* bus() { return bus_ ? &*bus_ : nullptr; }
  /// The board's clock at the scenario's time 0.
  hal::Time start() const { return start_; }
  /// The last result of identify or calibrate on a channel, 1: a joint's antagonist or a bundle's
  /// second muscle; empty: none.
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
  /// The reference at this tick; NaN: none. Begins a first motion when the muscle is armed.
  double reference_at(double time_s);
  void renew_command(double reference);
  void command_rest();
  void send(Verb verb, double value = 0.0);
  void housekeep();
  void pass_rows();
  void record(double time_s, double reference);
  /// After a tick: the limit that the reference alone exceeds.
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
