// The force of a hot muscle, which grows faster than its temperature.
#pragma once

#include "plant/effects.hpp"

namespace supercoil::host_sim {

/// F = γ φ (1 + sφ/2): the force per kelvin grows by s for each kelvin.
class ForceCurve {
 public:
  void set(const control::PhysicalParameters& parameters, const PlantEffects& effects) {
    linear_ = parameters.force_per_kelvin_N_per_K;
    square_ = 0.5 * linear_ * (effects.force_ratio - 1.0) / effects.force_ratio_at_K;
  }
  double force_N(double rise_K) const { return rise_K * (linear_ + square_ * rise_K); }

 private:
  double linear_ = 0.0;
  double square_ = 0.0;
};

}  // namespace supercoil::host_sim
