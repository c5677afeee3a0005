// Effects of a muscle's past: length from the first heating, age, water.
#pragma once

#include <algorithm>
#include <cmath>

#include "plant/effects.hpp"

namespace supercoil::host_sim {

/// x0 = −ℓ·min(1, φmax/φℓ): the rest position.
class LonelyStroke {
 public:
  void set(const PlantEffects& effects) {
    stroke_m_ = effects.lonely_stroke_m;
    per_K_ = 1.0 / effects.lonely_stroke_at_K;
  }
  double rest_m(double peak_rise_K) const {
    return -stroke_m_ * std::min(1.0, peak_rise_K * per_K_);
  }

 private:
  double stroke_m_ = 0.0;
  double per_K_ = 0.0;
};

/// Force falls in proportion to the path of the temperature; up and down by ageing_cycle_K is one
/// cycle.
class Ageing {
 public:
  void set(const PlantEffects& effects) {
    before_ratio_ = effects.ageing_ratio * effects.worn_cycles / effects.ageing_cycles;
    per_K_ = effects.ageing_ratio / (2.0 * effects.ageing_cycle_K * effects.ageing_cycles);
  }
  void step(double rise_change_K) { path_K_ += std::abs(rise_change_K); }
  double force_ratio() const { return std::max(0.0, 1.0 - before_ratio_ - per_K_ * path_K_); }

 private:
  double before_ratio_ = 0.0;
  double per_K_ = 0.0;
  double path_K_ = 0.0;
};

/// The water content approaches, with a time constant, what the muscle holds at its temperature:
/// all when cold, none at drying_K. Force grows with it.
class Moisture {
 public:
  void set(const PlantEffects& effects, double step_s) {
    if (water_ratio_ < 0.0) water_ratio_ = effects.water_ratio;
    cold_ratio_ = effects.water_ratio;
    force_per_ratio_ = effects.water_force_ratio;
    per_K_ = 1.0 / effects.drying_K;
    step_ratio_ = -std::expm1(-step_s / effects.drying_s);
  }
  /// rise_K: the mean of the step.
  void step(double rise_K) {
    const double stays = cold_ratio_ * std::min(1.0, std::max(0.0, 1.0 - rise_K * per_K_));
    water_ratio_ += step_ratio_ * (stays - water_ratio_);
  }
  double water_ratio() const { return water_ratio_; }
  double force_ratio() const { return 1.0 + force_per_ratio_ * water_ratio_; }

 private:
  double water_ratio_ = -1.0;  ///< negative before it is set
  double cold_ratio_ = 0.0;
  double force_per_ratio_ = 0.0;
  double per_K_ = 0.0;
  double step_ratio_ = 0.0;
};

}  // namespace supercoil::host_sim
