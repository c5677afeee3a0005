// Rate-independent hysteresis: plays in parallel.
#pragma once

#include <array>

#include "supercoil/control/hysteresis/play.hpp"

#include "plant/effects.hpp"

namespace supercoil::host_sim {

/// φe = (1 − w)φ + (w/5) Σ play(φ; jR/5), j = 1…5 (Prandtl–Ishlinskii). The full loop is 1.2 wR
/// wide.
class PlayHysteresis {
 public:
  static constexpr std::size_t plays = 5;

  /// Starts without memory: every play is where the temperature is.
  void rest_at(double rise_K) {
    for (control::Play& play : plays_)
      play.rest_at(rise_K);
  }

  void set(const PlantEffects& effects) {
    on_ = effects.hysteresis_ratio > 0.0;
    weight_ = effects.hysteresis_weight;
    const double width_K = effects.hysteresis_ratio * effects.hysteresis_range_K;
    for (std::size_t j = 0; j < plays; ++j)
      plays_[j].set_radius(static_cast<double>(j + 1) / plays * width_K / (1.2 * weight_));
  }

  /// The effective rise.
  double step(double rise_K) {
    if (!on_) {
      rest_at(rise_K);
      return rise_K;
    }
    double sum_K = 0.0;
    for (control::Play& play : plays_) {
      play.step(rise_K);
      sum_K += play.output();
    }
    return rise_K + weight_ * (sum_K * (1.0 / plays) - rise_K);
  }

 private:
  bool on_ = false;
  double weight_ = 0.5;
  std::array<control::Play, plays> plays_{};
};

}  // namespace supercoil::host_sim
