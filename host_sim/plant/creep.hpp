// Creep, which moves a muscle for minutes: two Maxwell branches in parallel with its spring.
#pragma once

#include <array>
#include <cmath>

#include "plant/effects.hpp"

namespace supercoil::host_sim {

/// Each branch is a spring in series with a damper. Both springs are equally stiff.
class Creep {
 public:
  /// Starts without tension.
  void rest_at(double position_m) { at_m_ = {position_m, position_m}; }

  void set(const control::PhysicalParameters& parameters, const PlantEffects& effects,
           double step_s) {
    stiffness_N_per_m_ = 0.5 * effects.creep_ratio * parameters.stiffness_N_per_m;
    step_ratio_ = {-std::expm1(-step_s / effects.creep_fast_s),
                   -std::expm1(-step_s / effects.creep_slow_s)};
  }
  /// Sum of both springs.
  double stiffness_N_per_m() const { return 2.0 * stiffness_N_per_m_; }
  /// Force towards the branches' own positions, at the beginning of a step.
  double pull_N() const { return stiffness_N_per_m_ * (at_m_[0] + at_m_[1]); }
  /// Change of that force over a step in which the position stays the same.
  double pull_change_N(double position_m) const {
    return stiffness_N_per_m_ *
           (step_ratio_[0] * (position_m - at_m_[0]) + step_ratio_[1] * (position_m - at_m_[1]));
  }
  /// The dampers yield over a step; position_m: its mean position.
  void step(double position_m) {
    at_m_[0] += step_ratio_[0] * (position_m - at_m_[0]);
    at_m_[1] += step_ratio_[1] * (position_m - at_m_[1]);
  }

 private:
  double stiffness_N_per_m_ = 0.0;
  std::array<double, 2> step_ratio_{};
  std::array<double, 2> at_m_{};
};

}  // namespace supercoil::host_sim
