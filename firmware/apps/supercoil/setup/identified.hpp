// What identify found, beside what was configured.
#pragma once

#include <array>
#include <cmath>

#include <nlohmann/json_fwd.hpp>

#include "apps/supercoil/setup/operator.hpp"
#include "loop/known_muscle.hpp"
#include "loop/settings.hpp"

namespace supercoil::operating {

/// Standard, relative, of what identify finds; NaN: not known. Moving mass and force per kelvin are
/// taken as configured.
struct IdentifiedDeviations {
  std::array<double, 4> parameters{};  ///< the first of control::physical_ranges
  double time_constant = NAN;
  double gain = NAN;  ///< of position over power, at rest
};
/// To first order from those of theta, as if these did not depend on each other. NaN of theta1
/// alone: identify scaled it with theta3, and each parameter rests on what was believed; time
/// constant and gain do not.
IdentifiedDeviations identified_deviations(const control::PhysicalParameters& muscle,
                                           const std::array<double, 4>& theta_ratios);

/// Lines for people; what it returns is for programs.
nlohmann::ordered_json tell_identified(const KnownMuscle& known, const ChannelSettings& configured,
                                       Operator& who);

}  // namespace supercoil::operating
