// From demanded watts to a PWM step, and back to the watts that it really gives.
#pragma once

#include <algorithm>
#include <cmath>

namespace supercoil::board {

/// P = D V²/R for a switch that is closed for the fraction D of each period, so D = P R/V². (Not
/// √(P R)/V: that duty gives the right mean voltage, not the right power: 1.5 W asked would give
/// 4.6 W.)
class PowerStage {
 public:
  struct Settings {
    int steps = 4095;            ///< of the PWM's period, ≥ 1
    bool error_feedback = true;  ///< what rounding took from one duty is added to the next
  };
  /// One tick's PWM step, and the power that it gives.
  struct Output {
    int step = 0;
    double duty = 0.0;
    double applied_W = 0.0;  ///< given to controller and estimator
    bool clipped = false;    ///< the supply cannot give what was demanded
  };

  explicit PowerStage(const Settings& settings) : settings_(settings) {}

  /// demanded_W ≥ 0, resistance_Ohm and supply_V as measured; the applied power never exceeds
  /// max_W, with or without error feedback. A value that must be positive and is not gives 0.
  Output step(double demanded_W, double resistance_Ohm, double supply_V, double max_W) {
    const double full_W = supply_V * supply_V / resistance_Ohm;
    const bool usable =
        std::isfinite(full_W) && full_W > 0.0 && resistance_Ohm > 0.0 && supply_V > 0.0;
    if (!usable || !(demanded_W > 0.0)) return off(demanded_W > 0.0 || std::isnan(demanded_W));
    const double steps_per_W = settings_.steps / full_W;
    const double exact = demanded_W * steps_per_W + remainder_;
    const int max_step = whole(max_W * steps_per_W);
    const int step = std::min(whole(exact + 0.5), max_step);
    remainder_ = settings_.error_feedback ? std::clamp(exact - step, -1.0, 1.0) : 0.0;
    const double duty = static_cast<double>(step) / settings_.steps;
    return {step, duty, duty * full_W, demanded_W > full_W};
  }

  void reset() { remainder_ = 0.0; }

 private:
  /// Rounded down and limited to 0 to `steps`; 0 for NaN. (std::floor would be a call.)
  int whole(double steps) const {
    return steps > 0.0 ? static_cast<int>(std::min(steps, static_cast<double>(settings_.steps)))
                       : 0;
  }
  Output off(bool clipped) {
    remainder_ = 0.0;
    return {0, 0.0, 0.0, clipped};
  }

  Settings settings_;
  double remainder_ = 0.0;
};

}  // namespace supercoil::board
