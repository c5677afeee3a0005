// The fastest motion towards a reference that a muscle can make: heat is limited, and it cools by
// itself.
#pragma once

#include <cstdint>

#include "supercoil/control/estimation/estimate.hpp"
#include "supercoil/control/estimation/parametric_model.hpp"
#include "supercoil/control/tracking/law.hpp"
#include "supercoil/control/tracking/reference_model.hpp"

namespace supercoil::control {

/// What a muscle cannot do that a reference asks of it.
enum class Infeasible : std::uint8_t {
  nothing,
  cooling,  ///< it would have to be cooled
  heating,  ///< it would need more than the greatest power
};

/// The reference that a muscle can follow, and why it is not the one that was asked for.
struct FeasibleReference {
  double reference_m = 0.0;
  Infeasible what = Infeasible::nothing;
};

/// Under a reference r the model's motion has the jerk x⃛ = g r − a2 ẍ − a1 ẋ − a0 x, and a muscle
/// needs P = θ1 m̂x⃛ + θ2 ẍ + θ3 ẋ + θ4 x + θ5 to move so. P rises with r: where it leaves the range,
/// the r at the range's end is taken instead. The model then moves as the muscle with just that
/// power, and goes on to the reference as itself as soon as it can.
class ReferenceShaper {
 public:
  /// model: the one that the reference goes through. muscle: until retune().
  ReferenceShaper(const ReferenceModelSettings& model, const RegressionScale& muscle)
      : model_(model), theta_(muscle.nominal), moving_mass_kg_(muscle.moving_mass_kg) {}

  /// The muscle was identified. What else pulls at it is not the muscle's.
  void retune(const Theta& theta) { theta_ = theta; }
  /// Goes by the estimate while that is trusted, then by the last that was.
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

  /// What the muscle needs for the model's motion under a reference.
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
