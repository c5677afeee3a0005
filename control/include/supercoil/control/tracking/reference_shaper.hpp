// The fastest motion towards a reference that a muscle can make: heating is limited, and cooling is
// passive.
#pragma once

#include <cstdint>

#include "supercoil/control/estimation/estimate.hpp"
#include "supercoil/control/estimation/parametric_model.hpp"
#include "supercoil/control/tracking/law.hpp"
#include "supercoil/control/tracking/reference_model.hpp"

namespace supercoil::control {

/// Why a muscle cannot follow a reference.
enum class Infeasible : std::uint8_t {
  nothing,
  cooling,  ///< it would have to be cooled
  heating,  ///< it would need more than the maximum power
};

/// The reference that a muscle can follow, and why it is not the demanded one.
struct FeasibleReference {
  double reference_m = 0.0;
  Infeasible infeasible = Infeasible::nothing;
};

/// Under a reference r the model's motion has the jerk x⃛ = g r − a2 ẍ − a1 ẋ − a0 x, and a muscle
/// needs P = θ1 m̂x⃛ + θ2 ẍ + θ3 ẋ + θ4 x + θ5 to move like that. P rises with r: when P leaves the
/// range, the r at the end of the range is used instead. The model then moves like the muscle with
/// exactly that power, and resumes its own motion to the reference as soon as it can.
class ReferenceShaper {
 public:
  /// model: the reference model in use. muscle: used until retune().
  ReferenceShaper(const ReferenceModelSettings& model, const RegressionScale& muscle)
      : model_(model), theta_(muscle.nominal), moving_mass_kg_(muscle.moving_mass_kg) {}

  /// The muscle was identified. The bias stays: external loads do not belong to the muscle.
  void retune(const Theta& theta) { theta_ = theta; }
  /// Uses the estimate while it is trusted, then the last trusted one.
  void learn(const Estimate& estimate) {
    if (!estimate.trusted) return;
    theta_ = estimate.theta;
    bias_W_ = estimate.bias_W;
  }

  /// motion: of the model at this tick, in metres.
  FeasibleReference step(double reference_m, const ModelMotion<double>& motion,
                         const PowerRange& range) const {
    const double needed_W = power_W(reference_m, motion);
    const double given_W = range.clip(needed_W);
    if (needed_W == given_W) return {reference_m};
    const double shaped_m =
        reference_m + (given_W - needed_W) / (theta_[0] * moving_mass_kg_ * model_.gain);
    return {shaped_m, needed_W < given_W ? Infeasible::cooling : Infeasible::heating};
  }

  /// The power that the muscle needs for the model's motion under a reference.
  double power_W(double reference_m, const ModelMotion<double>& at) const {
    const Polynomial<3>& a = model_.denominator;
    const double jerk = model_.gain * reference_m - a[2] * at.acceleration - a[1] * at.velocity -
                        a[0] * at.position;
    return theta_[0] * moving_mass_kg_ * jerk + theta_[1] * at.acceleration +
           theta_[2] * at.velocity + theta_[3] * at.position + bias_W_;
  }

 private:
  ReferenceModelSettings model_;
  Theta theta_;
  double moving_mass_kg_;
  double bias_W_ = 0.0;
};

}  // namespace supercoil::control
