// An estimator's result.
#pragma once

#include <cmath>

#include "supercoil/control/actuator/parameters.hpp"

namespace supercoil::control {

/// θ of the muscle and how well it is known: P = θ1 m̂x⃛ + θ2 ẍ + θ3 ẋ + θ4 x.
struct Estimate {
  Theta theta;                        ///< in θ's own units
  double prediction_error_W = 0.0;    ///< ε = z − θᵀφ, through 1/Λ or 1/Λ'
  double excitation_W2s = 0.0;        ///< λmin of ∫φφᵀ, see ExcitationMonitor; gradient only
  double relative_error_bound = 0.0;  ///< of all parameters together; infinity at first
  bool trusted = false;               ///< that bound is small enough
  /// θ is near enough to be used, even when not yet trusted: see each estimator.
  bool settled = false;
  double bias_W = 0.0;  ///< of the power, constant; the gradient law has none
  /// Standard deviations from least squares; infinity when the law has none.
  Theta deviation = Theta::Constant(INFINITY);
  double bias_deviation_W = INFINITY;
};

}  // namespace supercoil::control
