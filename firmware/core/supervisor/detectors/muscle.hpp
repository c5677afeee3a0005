// Is too much asked of the muscle?
#pragma once

#include "supervisor/detectors/limits.hpp"

namespace supercoil::detectors {

/// Trips when more energy went in within about window_s than the muscle may take. A leaky integral
/// with time constant window_s: a constant power of energy_J/window_s just fills it.
class EnergyBudget final : public Detector {
 public:
  struct Settings {
    double energy_J;
    double window_s;
  };
  EnergyBudget(const Settings& settings, double step_s)
      : settings_(settings), step_s_(step_s), decay_(step_s / settings.window_s) {}

  bool step(double power_W) {
    spent_J_ += power_W * step_s_ - spent_J_ * decay_;
    return !(spent_J_ <= settings_.energy_J);
  }
  Margin margin() const override { return rising(spent_J_, settings_.energy_J); }

 private:
  Settings settings_;
  double step_s_;
  double decay_;  ///< fraction forgotten per step
  double spent_J_ = 0.0;
};

/// Trips when the heater's resistance is more than `part` outside its range over all temperatures
/// that the muscle may have: at once if a probe measured it, after hold_s if it is the smoothed one
/// of a heating muscle.
class ResistanceDrift final : public Detector {
 public:
  struct Settings {
    double tolerance_ratio;
    double hold_s;
  };
  ResistanceDrift(const Settings& settings, double step_s)
      : settings_(settings), held_(settings.hold_s, step_s) {}

  /// min_warm_Ohm and max_warm_Ohm: bounds for a muscle that is as it was calibrated.
  bool step(double measured_Ohm, double min_warm_Ohm, double max_warm_Ohm, bool probed) {
    measured_Ohm_ = measured_Ohm;
    low_Ohm_ = min_warm_Ohm * (1.0 - settings_.tolerance_ratio);
    high_Ohm_ = max_warm_Ohm * (1.0 + settings_.tolerance_ratio);
    falls_ = measured_Ohm < min_warm_Ohm;
    const bool outside = !(measured_Ohm >= low_Ohm_ && measured_Ohm <= high_Ohm_);
    return held_.step(outside) || (probed && outside);
  }
  /// Nothing was measured at this tick.
  void skip() { held_.step(false); }
  Margin margin() const override {
    return falls_ ? falling(measured_Ohm_, low_Ohm_) : rising(measured_Ohm_, high_Ohm_);
  }

 private:
  Settings settings_;
  HoldTimer held_;
  double measured_Ohm_ = 0.0;
  double low_Ohm_ = 0.0;
  double high_Ohm_ = 0.0;
  bool falls_ = false;
};

}  // namespace supercoil::detectors
