// A fit in terms of control: θ, and a muscle's physical parameters.
#pragma once

#include <optional>

#include "supercoil/control/actuator/parameters.hpp"
#include "supercoil/identification/fit.hpp"

namespace supercoil::identification {

/// What position and power cannot determine. Scaling heat capacity, heat transfer and force per
/// kelvin alike leaves the motion unchanged; so does scaling mass, damping, stiffness and force.
/// Neither changes how the muscle is controlled; the first decides how hot it is assumed to be.
struct Assumed {
  double thermal_mass_J_per_K = control::PhysicalParameters{}.thermal_mass_J_per_K;
  double stiffness_N_per_m = control::PhysicalParameters{}.stiffness_N_per_m;
  /// If given, replaces the stiffness, which then follows from the natural frequency.
  std::optional<double> moving_mass_kg;
};

/// The linear part of a muscle.
control::PhysicalParameters physical_from(const Muscle& muscle, const Assumed& assumed);

/// θ of the linear part, in its own units, with standard deviations that include the model's error.
struct ThetaEstimate {
  control::Theta theta;
  control::Vector<double, 4> deviation;
};
ThetaEstimate theta_of(const Fit& fit, const Assumed& assumed);

}  // namespace supercoil::identification
