// Bounds of the power that acted, given the errors of the senses.
#pragma once

#include <algorithm>

#include "board/learned.hpp"
#include "board/measurement.hpp"

namespace supercoil::board {

/// The current is known in two ways: by the duty, with the supply and the calibrated resistance,
/// and by the current sense. A wrong sense affects them differently, so the worse of the two
/// counts, each with its senses' error bounds. Until the senses are compared with a meter, those
/// bounds are the largest errors that no detector would notice.
class PowerBounds {
 public:
  struct Settings {
    double min_supply_V = 9.0;  ///< the true supply lies between these
    double max_supply_V = 15.0;
    double resistance_tolerance_ratio = 0.3;  ///< resistance_drift notices no smaller error
    double current_noise_A = 0.01;            ///< a smaller current counts as none
    double max_W = 4.5;                       ///< the channel's, assumed while a reading is missing
    /// Heat in the muscle over electrical power, besides errors of the senses.
    double min_power_ratio = 1.0;
    double max_power_ratio = 1.0;
  };
  /// In the unit of what it bounds; min <= max.
  struct Interval {
    double min;
    double max;
  };

  explicit PowerBounds(const Settings& settings) : settings_(settings) {}

  /// A comparison with a meter; one with error_ratio 0 counts as none.
  void set(const board::SenseComparison& senses) {
    error_ratio_ = senses.error_ratio;
    compared_ = senses.compared();
  }
  bool compared() const { return compared_; }

  /// In W, for the power since the last tick. duty: as it was set; supply_V: as measured, 0 when
  /// absent; resistance_Ohm: range of the calibrated heater at its present temperature.
  Interval step(double duty, double supply_V, const Measured& current,
                const Interval& resistance_Ohm) const {
    const Settings& s = settings_;
    if (!(supply_V > 0.0) || !current.present) {
      const double set_W = duty * s.max_supply_V * s.max_supply_V / resistance_Ohm.min;
      return {0.0, std::max(s.max_W, set_W) * s.max_power_ratio};
    }
    // Compared senses measure small currents too; current without a duty may still be noise.
    const bool counts_all = compared_ && duty > 0.0;
    const double measured_A = std::max(0.0, current.value - (counts_all ? 0.0 : s.current_noise_A));
    const Interval supply = true_over_measured_supply(supply_V);
    const Interval sense = true_over_measured_current(supply);
    const double max_V = supply_V * supply.max;
    const double max_A = std::max(duty * max_V / resistance_Ohm.min, measured_A * sense.max);
    const double min_V = supply_V * supply.min;
    const double min_A =
        std::min(min_set_A(duty, supply_V, resistance_Ohm), measured_A * sense.min);
    return {min_V * min_A * s.min_power_ratio, max_V * max_A * s.max_power_ratio};
  }

  /// True over measured power, at this supply and on a muscle that is as it was calibrated.
  Interval true_over_measured(double supply_V) const {
    const Interval supply = true_over_measured_supply(supply_V);
    const Interval sense = true_over_measured_current(supply);
    return {supply.min * sense.min * settings_.min_power_ratio,
            supply.max * sense.max * settings_.max_power_ratio};
  }
  /// At any supply without a fault.
  Interval true_over_measured() const {
    return {true_over_measured(settings_.max_supply_V).min,
            true_over_measured(settings_.min_supply_V).max};
  }

 private:
  Interval true_over_measured_supply(double supply_V) const {
    if (compared_) return {1.0 - error_ratio_, 1.0 + error_ratio_};
    return {std::min(1.0, settings_.min_supply_V / supply_V),
            std::max(1.0, settings_.max_supply_V / supply_V)};
  }
  /// Lower bound of the current by the duty alone. Senses that were not compared may hide a worn
  /// heater. A compared current sense lags when the duty falls, and then reads more than the
  /// minimum resistance can draw.
  double min_set_A(double duty, double supply_V, const Interval& resistance_Ohm) const {
    const Interval supply = true_over_measured_supply(supply_V);
    const double tolerance = settings_.resistance_tolerance_ratio;
    if (!compared_) return duty * supply_V * supply.min / (resistance_Ohm.max * (1.0 + tolerance));
    const double min_warm_Ohm = resistance_Ohm.min * std::max(0.1, 1.0 - tolerance);
    return duty * supply_V * supply.min / min_warm_Ohm;
  }
  /// Of two senses that were never compared, only their ratio, the resistance, is checked.
  Interval true_over_measured_current(const Interval& supply) const {
    if (compared_) return supply;
    const double max_gain_error = 1.0 + settings_.resistance_tolerance_ratio;
    return {supply.min / max_gain_error, supply.max * max_gain_error};
  }

  Settings settings_;
  double error_ratio_ = 0.0;
  bool compared_ = false;
};

}  // namespace supercoil::board
