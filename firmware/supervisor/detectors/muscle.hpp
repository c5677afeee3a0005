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
  EnergyBudget(const Settings& settings, double step_s) : settings_(settings), step_s_(step_s) {}

  bool step(double power_W) {
    spent_J_ += (power_W - spent_J_ / settings_.window_s) * step_s_;
    margin_ = rising(spent_J_, settings_.energy_J);
    return !(spent_J_ <= settings_.energy_J);
  }
  const Margin& margin() const { return margin_; }

 private:
  Settings settings_;
  double step_s_;
  double spent_J_ = 0.0;
  Margin margin_;
};

/// Trips when the cold resistance, measured by a probe while the muscle is cold, is further from
/// its calibration than `part` of it.
class ResistanceDrift {
 public:
  struct Settings {
    double calibrated_Ohm;
    double part;
  };
  explicit ResistanceDrift(const Settings& settings) : settings_(settings) {}

  /// At each probe of a cold muscle.
  bool step(double cold_Ohm) {
    const double change_Ohm = std::abs(cold_Ohm - settings_.calibrated_Ohm);
    const double allowed_Ohm = settings_.part * settings_.calibrated_Ohm;
    margin_ = rising(change_Ohm, allowed_Ohm);
    return !(change_Ohm <= allowed_Ohm);
  }
  const Margin& margin() const { return margin_; }

 private:
  Settings settings_;
  Margin margin_;
};

}  // namespace supercoil::detectors
