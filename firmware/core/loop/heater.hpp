// A muscle's heater: its measurements, the temperature that it causes, and its drive.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>

#include "supercoil/control/tracking/law.hpp"

#include "board/applied_power.hpp"
#include "board/devices.hpp"
#include "board/heat.hpp"
#include "board/learned.hpp"
#include "board/power_stage.hpp"
#include "board/probe.hpp"
#include "board/resistance.hpp"
#include "loop/settings.hpp"
#include "loop/snapshot.hpp"
#include "supervisor/channel_inputs.hpp"
#include "supervisor/channel_state.hpp"

namespace supercoil {

/// Gains and remaining error of the senses, from the loop to other threads.
class PublishedSenses {
 public:
  /// In the loop's thread.
  void set(const board::SenseComparison& senses) {
    supply_.store(senses.supply_gain, std::memory_order_relaxed);
    current_.store(senses.current_gain, std::memory_order_relaxed);
    error_.store(senses.error_ratio, std::memory_order_relaxed);
  }
  board::SenseComparison get() const {
    return {supply_.load(std::memory_order_relaxed), current_.load(std::memory_order_relaxed),
            error_.load(std::memory_order_relaxed), 0.0};
  }

 private:
  std::atomic<double> supply_{1.0};
  std::atomic<double> current_{1.0};
  std::atomic<double> error_{0.0};
};

/// Measures a heater, bounds the temperature that its power causes, and limits and sets that power.
class Heater {
 public:
  /// Devices outlive the heater.
  Heater(const ChannelSettings& settings, const BoardSettings& board,
         const board::ChannelDevices& devices);

  // In a tick, in this order.
  /// Takes the newest current, corrected by the comparison with a meter.
  void sample(hal::Time now);
  /// Updates the muscle's temperature by the power that acted since the last tick, as set and as
  /// measured. supply_V: as read. air: in °C, null without a sensor. periods: since the last tick.
  void observe(double supply_V, const board::Measured* air, std::int64_t periods);
  /// This tick's inputs for the supervisor.
  const HeaterInputs& inputs(const ChannelState& state);
  /// Writes the heater's part of the snapshot.
  void publish(Snapshot& s) const;
  /// proven_W: the power that the proof of response allows. lowered_by: the limit because of which
  /// the demand was lowered to make room for a dither.
  void limit(const ChannelState& state, double demanded_W, double proven_W, LimitedBy lowered_by);
  /// may_probe: an old resistance may be measured again. dither_W: included in the power.
  void drive(const ChannelState& state, bool may_probe, double dither_W);

  /// Duty 0 and enable low, at once.
  void cut();
  /// The next rise of power begins at 0.
  void rest();
  /// For the self-test: sets duty and enable line directly.
  void test_drive(double duty, bool enable);
  void start_probe() { probe_.start(); }

  /// Applies a comparison with a meter. resistance_scale: a resistance by the new senses over the
  /// same by the old ones.
  void apply_comparison(const board::SenseComparison& senses, double resistance_scale);
  /// Applies what was learned of the muscle's heat.
  void set_thermal_facts(const board::ThermalFacts& facts);
  /// The resistance that calibrate found. Temperatures by resistance and the power's bounds use it.
  void calibrate(double cold_Ohm) { cold_Ohm_ = cold_Ohm; }
  /// Takes the muscle's thermal pole from a trusted estimate.
  void learn(double pole_rad_per_s) { heat_.learn(pole_rad_per_s); }
  /// As Heat::set_muscle().
  void set_muscle(const control::PhysicalParameters& muscle) { heat_.set_muscle(muscle); }
  /// Of the limiter; between ticks only.
  void set_power_range(double min_W, double max_W) { limiter_.set_range(min_W, max_W); }
  /// From any thread. Limits the power to max_W and the configured maximum.
  void allow_power(double max_W) { max_power_W_.store(max_W, std::memory_order_relaxed); }
  double max_power_W() const { return max_power_W_.load(std::memory_order_relaxed); }
  /// From any thread.
  board::SenseComparison published_senses() const { return published_senses_.get(); }

  const board::Measured& current() const { return current_; }
  double supply_V() const { return supply_V_; }
  /// Resistance at the muscle's coldest and hottest, for a heater of cold_Ohm when cold. Inline:
  /// the caller would wait for two numbers that a call returns.
  board::PowerBounds::Interval warm_Ohm(double cold_Ohm) const {
    const double per_K = settings_.temperature_coefficient_per_K;
    return {cold_Ohm * (1.0 + per_K * heat_.coldest_K()),
            cold_Ohm * (1.0 + per_K * heat_.hottest_K())};
  }
  bool probing() const { return probe_.running(); }
  /// The current sense's reading still contains a probe.
  bool probe_settling() const { return settling_ticks_ > 0; }
  double resistance_age_s() const { return resistance_.age_s(); }
  /// Whether a probe ended in this tick. probed_Ohm(): its result, or 0.
  bool probe_ended() const { return probed_ || probe_failed_; }
  double probed_Ohm() const { return probed_ ? resistance_.value_Ohm() : 0.0; }
  /// Whether the resistance indicates the muscle's temperature now.
  bool indicates_temperature() const { return indicates_temperature_; }
  /// The rise that it indicates; 0: none.
  double from_resistance_K() const { return inputs_.from_resistance_K; }
  const board::Heat& heat() const { return heat_; }
  /// The muscle must have cooled since boot, however hot it was before.
  bool heat_known() const { return heat_known_; }
  const board::SenseComparison& senses() const { return senses_; }
  const board::ThermalFacts& facts() const { return facts_; }
  const board::PowerBounds& power_bounds() const { return power_bounds_; }
  /// The power in this tick, as compared senses measure it.
  board::PowerBounds::Interval measured_power_W() const;
  /// The range that a controller may count on.
  control::PowerRange power_range() const {
    return {limiter_.min_W(), std::min(limiter_.max_W(), full_scale_W_)};
  }
  const Limiter& limiter() const { return limiter_; }
  const Limiter::Result& allowed() const { return allowed_; }
  /// Why the limiter gave less than the demand with its dither. A demand that only makes room for
  /// the dither is not cut.
  LimitedBy cut_by() const { return cut_by_; }
  const board::AppliedPower& acting() const { return acting_; }
  bool lines_ok() const { return lines_ok_; }

 private:
  void observe_power(std::int64_t periods);
  void follow_probe();
  /// From the last measurements.
  void calculate_full_scale() { full_scale_W_ = supply_V_ * supply_V_ / resistance_.value_Ohm(); }
  void write_duty(int step);
  void write_enable(bool high);

  /// Above this rise the muscle's sensor must show at least its own noise.
  static constexpr double hot_K = 5.0;

  HeaterSettings settings_;
  board::ChannelDevices devices_;
  double current_noise_A_;
  double derate_from_C_;
  double cold_Ohm_;  ///< as calibrated

  board::SenseComparison senses_;
  PublishedSenses published_senses_;
  board::ThermalFacts facts_;
  board::Measured current_;
  double supply_V_ = 0.0;
  double full_scale_W_ = 0.0;  ///< at a duty of 1
  HeaterInputs inputs_;
  board::Resistance resistance_;
  board::PowerBounds power_bounds_;
  board::PowerBounds::Interval power_W_{0.0, 0.0};  ///< bounds of the power that acted
  board::Heat heat_;
  bool heat_known_ = false;
  bool indicates_temperature_ = false;
  board::Probe probe_;
  bool probed_ = false;
  bool probe_failed_ = false;
  int sense_ticks_;         ///< until the current sense has settled after a probe
  int settling_ticks_ = 0;  ///< how many of them are left
  std::atomic<double> max_power_W_;
  Limiter limiter_;
  Limiter::Result allowed_;
  LimitedBy cut_by_ = LimitedBy::nothing;
  board::PowerStage power_stage_;
  board::OutputDelay delay_;
  board::AppliedPower set_;     ///< at this tick
  board::AppliedPower acting_;  ///< from this tick to the next
  int written_step_ = -1;
  int written_enable_ = -1;
  bool writes_ok_ = true;
  bool lines_ok_ = true;
};

}  // namespace supercoil
