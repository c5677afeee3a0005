// The pull of a joint's muscle, by its model.
#pragma once

#include <algorithm>
#include <cmath>

#include "supercoil/control/actuator/parameters.hpp"

#include "loop/settings.hpp"

namespace supercoil {

/// From the pretension, what its heat adds, and what its contraction takes: nothing measures it.
/// Does nothing where the pretension is not known.
class ModelledPull {
 public:
  explicit ModelledPull(const PlaceInJoint& place) : place_(place) {}

  /// power_W acted for time_s.
  void step(double power_W, double time_s, const control::PhysicalParameters& muscle) {
    if (!place_.knows_pull()) return;
    const double per_s = muscle.heat_transfer_W_per_K / muscle.thermal_mass_J_per_K;
    heat_W_ += std::min(1.0, per_s * time_s) * (power_W - heat_W_);
  }
  /// The steady power that would keep it as hot as it is.
  double heat_W() const { return heat_W_; }
  /// position_m: its own contraction. At most 0: slack; NaN: not known.
  double at_N(double position_m, const control::PhysicalParameters& muscle) const {
    if (!place_.knows_pull()) return NAN;
    return place_.cold_pull_N(position_m, muscle.stiffness_N_per_m) +
           newtons_per_watt(muscle) * heat_W_;
  }
  /// The steady power that keeps it taut there, with a tenth of what its contraction takes in
  /// reserve; NaN: not known.
  double taut_W(double position_m, const control::PhysicalParameters& muscle) const {
    constexpr double reserve_ratio = 1.1;
    return -place_.cold_pull_N(reserve_ratio * position_m, muscle.stiffness_N_per_m) /
           newtons_per_watt(muscle);
  }

 private:
  static double newtons_per_watt(const control::PhysicalParameters& muscle) {
    return muscle.force_per_kelvin_N_per_K / muscle.heat_transfer_W_per_K;
  }

  PlaceInJoint place_;
  double heat_W_ = 0.0;
};

}  // namespace supercoil
