// How hot the muscle is, according to its learned thermal pole.
#pragma once

#include <cmath>

namespace supercoil::control {

/// ψφ̇ = −ηφ + P with ψ0 fixed at set-up and η̂ = −s0·ψ0, s0 the learned thermal pole: neither ψ
/// nor η can be identified from position and power alone, but their ratio can (docs/paper.md).
class ThermalObserver {
 public:
  /// thermal_mass_J_per_K > 0, step_s > 0. rise_K() is 0 until a pole is learned.
  ThermalObserver(double thermal_mass_J_per_K, double step_s)
      : thermal_mass_J_per_K_(thermal_mass_J_per_K), step_s_(step_s) {}

  /// pole_rad_per_s < 0; anything else is ignored.
  void learn(double pole_rad_per_s) {
    if (!(pole_rad_per_s < 0.0) || !std::isfinite(pole_rad_per_s)) return;
    decay_ = std::exp(pole_rad_per_s * step_s_);
    per_W_K_ = -1.0 / (pole_rad_per_s * thermal_mass_J_per_K_);
    learned_ = true;
  }

  /// As if no pole had been learned.
  void forget() {
    learned_ = false;
    rise_K_ = 0.0;
  }

  /// power_W ≥ 0, applied since the last tick.
  void step(double power_W) {
    if (!learned_) return;
    const double rest_K = power_W * per_W_K_;
    rise_K_ = rest_K + (rise_K_ - rest_K) * decay_;
  }
  double rise_K() const { return rise_K_; }

 private:
  double thermal_mass_J_per_K_;
  double step_s_;
  double decay_ = 1.0;
  double per_W_K_ = 0.0;
  double rise_K_ = 0.0;
  bool learned_ = false;
};

}  // namespace supercoil::control
