// Is the muscle being asked too much?
#pragma once

#include "supervisor/detectors/limits.hpp"

namespace supercoil::detectors {

/// Trips when, within about window_s, more energy went in than the muscle may take. A leaky
/// integral: energy leaves the account at the rate of energy_J/window_s in proportion to what is on
/// it, so that a constant power of energy_J/window_s just fills it.
class EnergyBudget {
 public:
  struct Settings {
    double energy_J;
    double window_s;
  };
  EnergyBudget(const Settings& settings, double step_s)
      : settings_(settings), step_s_(step_s), forgotten_(step_s / settings.window_s) {}

  bool step(double power_W) {
    spent_J_ += power_W * step_s_ - spent_J_ * forgotten_;
    margin_ = rising(spent_J_, settings_.energy_J);
    return !(spent_J_ <= settings_.energy_J);
  }
  const Margin& margin() const { return margin_; }

 private:
  Settings settings_;
  double step_s_;
  double forgotten_;  ///< in a step, of what was spent
  double spent_J_ = 0.0;
  Margin margin_;
};

/// Trips when the heater's resistance is further than `part` outside of what it can be at any
/// temperature that the muscle may have: at once when a probe measured it, after hold_s when it is
/// the smoothed one of a heating muscle.
class ResistanceDrift {
 public:
  struct Settings {
    double part;
    double hold_s;
  };
  ResistanceDrift(const Settings& settings, double step_s)
      : settings_(settings), held_(settings.hold_s, step_s) {}

  /// least_Ohm and most_Ohm: between these a muscle lies that is as it was calibrated.
  bool step(double measured_Ohm, double least_Ohm, double most_Ohm, bool probed) {
    const double low_Ohm = least_Ohm * (1.0 - settings_.part);
    const double high_Ohm = most_Ohm * (1.0 + settings_.part);
    const bool outside = !(measured_Ohm >= low_Ohm && measured_Ohm <= high_Ohm);
    const bool falls = measured_Ohm < least_Ohm;
    margin_ = falls ? falling(measured_Ohm, low_Ohm) : rising(measured_Ohm, high_Ohm);
    return held_.step(outside) || (probed && outside);
  }
  /// Nothing was measured at this tick.
  void skip() { held_.step(false); }
  const Margin& margin() const { return margin_; }

 private:
  Settings settings_;
  HeldFor held_;
  Margin margin_;
};

}  // namespace supercoil::detectors
