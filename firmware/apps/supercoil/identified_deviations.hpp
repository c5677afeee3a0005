// How accurately identify knows each parameter, the time constant and the gain: for the terminal
// and the page.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "loop/known_muscle.hpp"

namespace supercoil::operating {

/// What is found of a muscle: the first of control::physical_ranges, time constant (s) and gain at
/// rest (m/W).
inline constexpr std::size_t identified_parameters = 4;
inline constexpr std::size_t identified_time_constant = identified_parameters;
inline constexpr std::size_t identified_gain = identified_time_constant + 1;
using IdentifiedValues = std::array<double, identified_gain + 1>;
IdentifiedValues identified_values(const control::PhysicalParameters& muscle);

/// Relative standard deviations of what identify finds; NaN: not known. Moving mass and force per
/// kelvin are taken as configured.
struct IdentifiedDeviations {
  std::array<double, identified_parameters> parameters{};  ///< the first of physical_ranges
  double time_constant = NAN;
  double gain = NAN;  ///< of position over power, at rest
};
/// To first order from the deviations of theta, as if these were independent. If only that of
/// theta1 is NaN, identify scaled theta1 with theta3, and each parameter rests on what was
/// believed; time constant and gain do not.
IdentifiedDeviations identified_deviations(const control::PhysicalParameters& muscle,
                                           const std::array<double, 4>& theta_ratios);

/// The physical parameters that a board uses.
control::PhysicalParameters physical_parameters(const KnownMuscle& known);
IdentifiedDeviations identified_deviations(const KnownMuscle& known);

/// With the names in JSON: "stiffness_N_per_m_deviation_ratio", "gain_deviation_ratio".
std::array<std::pair<std::string, double>, identified_gain + 1> named_deviations(
    const IdentifiedDeviations& deviations);

}  // namespace supercoil::operating
