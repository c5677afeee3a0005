// A muscle's temperature when its heat transfer depends on temperature.
#pragma once

#include <algorithm>
#include <cmath>

#include "plant/effects.hpp"

namespace supercoil::host_sim {

/// ψφ̇ = P − η(φ)(φ − φa), η(φ) = η·draught·[c(|φ − φa|/φr)^¼ + r·rad(φ)/rad(φr) + 1 − c − r] with
/// rad(φ) = (T² + Ta²)(T + Ta).
class HeatTransfer {
 public:
  void set(const control::PhysicalParameters& parameters, const PlantEffects& effects,
           double step_s);
  void start_from(double rise_K);

  /// The muscle's heat transfer at this rise.
  double conductance_W_per_K(double rise_K) const {
    const double above_air_K = rise_K - air_K_;
    return constant_W_per_K_ + convection_W_per_K_ * std::sqrt(std::sqrt(std::abs(above_air_K))) +
           radiation_ * radiation(absolute_air_K_ + above_air_K, absolute_air_K_);
  }

  /// The rise after a step at constant power. The heat transfer at the middle of the step is
  /// extrapolated linearly from the two steps before: it changes slowly, and the step need not wait
  /// for its costly computation. Heat that is not stored is lost to the air, to within rounding.
  double step(double power_W) {
    const double middle_W_per_K =
        std::max(0.0, last_W_per_K_ + 1.5 * (last_W_per_K_ - before_W_per_K_));
    const double above_K = rise_K_ - air_K_;
    const double middle_K =
        (above_K + half_step_K_per_W_ * power_W) / (1.0 + half_step_K_per_W_ * middle_W_per_K);
    loss_J_ = step_s_ * middle_W_per_K * middle_K;
    before_W_per_K_ = last_W_per_K_;
    last_W_per_K_ = conductance_W_per_K(rise_K_);
    before_rise_K_ = rise_K_;
    rise_K_ += 2.0 * (middle_K - above_K);
    return rise_K_;
  }
  double rise_K() const { return rise_K_; }
  /// Heat lost to the air in the last step.
  double loss_J() const { return loss_J_; }

 private:
  static double radiation(double absolute_K, double air_K) {
    return (absolute_K * absolute_K + air_K * air_K) * (absolute_K + air_K);
  }

  double step_s_ = 1e-3;
  double half_step_K_per_W_ = 0.0;
  double constant_W_per_K_ = 0.0;
  double convection_W_per_K_ = 0.0;  ///< at 1 K above the air
  double radiation_ = 0.0;           ///< in W/K⁴
  double air_K_ = 0.0;
  double absolute_air_K_ = 0.0;
  double rise_K_ = 0.0;
  double before_rise_K_ = 0.0;
  double last_W_per_K_ = 0.0;    ///< at before_rise_K_
  double before_W_per_K_ = 0.0;  ///< a step earlier
  double loss_J_ = 0.0;
};

}  // namespace supercoil::host_sim
