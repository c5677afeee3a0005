// Stiffness that a muscle loses when it gets hot.
#pragma once

#include <algorithm>

#include "plant/effects.hpp"

namespace supercoil::host_sim {

inline constexpr double gravity_m_per_s2 = 9.81;

/// k(φ) falls from k0 along 3u² − 2u³ between two temperatures.
class Softening {
 public:
  void set(const control::PhysicalParameters& parameters, const PlantEffects& effects) {
    cold_N_per_m_ = parameters.stiffness_N_per_m;
    lost_N_per_m_ = cold_N_per_m_ * effects.softening_ratio;
    from_K_ = effects.softening_from_K;
    per_K_ = 1.0 / (effects.softening_to_K - effects.softening_from_K);
    stretch_m_ = effects.hanging_mass_kg * gravity_m_per_s2 / cold_N_per_m_;
  }
  double cold_N_per_m() const { return cold_N_per_m_; }
  double stiffness_N_per_m(double rise_K) const {
    const double u = std::min(std::max((rise_K - from_K_) * per_K_, 0.0), 1.0);
    return cold_N_per_m_ - lost_N_per_m_ * (u * u * (3.0 - 2.0 * u));
  }
  /// How far the hanging mass has stretched the cold muscle; the lost stiffness no longer holds
  /// this stretch.
  double stretch_m() const { return stretch_m_; }

 private:
  double cold_N_per_m_ = 1.0;
  double lost_N_per_m_ = 0.0;
  double from_K_ = 0.0;
  double per_K_ = 1.0;
  double stretch_m_ = 0.0;
};

}  // namespace supercoil::host_sim
