// The effort that a joint needs, divided between two muscles that pull against each other.
#pragma once

#include <cmath>

#include "supercoil/control/tracking/law.hpp"

namespace supercoil::control {

/// The power of both heaters, each in its own watts.
struct PairPower {
  double agonist_W = 0.0;
  double antagonist_W = 0.0;
};

/// A law moves a joint by one number, the effort v = P₁ − g P₂ in watts of the agonist. g is the
/// antagonist's DC gain over the agonist's: g watts of the agonist move the joint as far as one
/// watt of the antagonist. Stateless, so nothing can wind up.
class JointAllocation {
 public:
  /// The range of each heater's power.
  struct Ranges {
    PowerRange agonist;
    PowerRange antagonist;
  };

  /// gain_ratio: g > 0.
  explicit JointAllocation(double gain_ratio) : gain_ratio_(gain_ratio) {}

  /// Each muscle gives half of the effort, around co_contraction_W >= 0, at which both pull alike:
  /// P₁ = c + v/2, g P₂ = c − v/2. What one muscle cannot give is left to the other. Both powers
  /// are within their ranges; the effort is the demanded one, or the nearest that the ranges allow.
  /// An effort that is not finite gives NaN.
  PairPower divide(double effort_W, double co_contraction_W, const Ranges& ranges) const {
    if (!std::isfinite(effort_W)) return {NAN, NAN};
    const PowerRange against{gain_ratio_ * ranges.antagonist.min_W,
                             gain_ratio_ * ranges.antagonist.max_W};
    const double first_W = ranges.agonist.clip(co_contraction_W + 0.5 * effort_W);
    const double against_W = against.clip(first_W - effort_W);
    return {ranges.agonist.clip(against_W + effort_W), against_W / gain_ratio_};
  }

  /// The effort v of these powers.
  double effort_W(const PairPower& power) const {
    return power.agonist_W - gain_ratio_ * power.antagonist_W;
  }

 private:
  double gain_ratio_;
};

}  // namespace supercoil::control
