#include "apps/supercoil/identified_deviations.hpp"

#include <cmath>

#include "supercoil/control/actuator/conversions.hpp"

namespace supercoil::operating {

namespace {

using control::physical_ranges;
using control::PhysicalParameters;

/// Relative step of theta, either way, by which its effect is measured.
constexpr double step_ratio = 1e-4;

}  // namespace

IdentifiedValues identified_values(const PhysicalParameters& m) {
  return {m.thermal_mass_J_per_K, m.heat_transfer_W_per_K,           m.stiffness_N_per_m,
          m.damping_Ns_per_m,     -1.0 / m.thermal_pole_rad_per_s(), m.dc_gain_m_per_W()};
}

IdentifiedDeviations identified_deviations(const PhysicalParameters& muscle,
                                           const std::array<double, 4>& theta_ratios) {
  const control::Theta theta = control::theta_from(muscle);
  const control::KnownParameters taken{muscle.force_per_kelvin_N_per_K, muscle.moving_mass_kg};
  const IdentifiedValues values = identified_values(muscle);
  const bool theta1_scaled = std::isnan(theta_ratios[0]);
  IdentifiedValues squares{};
  for (int i = theta1_scaled ? 1 : 0; i < 4; ++i) {
    const auto moved = [&](double ratio) {
      control::Theta off = theta;
      off[i] *= ratio;
      if (theta1_scaled && i == 2) off[0] *= ratio;
      return control::physical_from(off, taken);
    };
    const auto more = moved(1.0 + step_ratio);
    const auto less = moved(1.0 - step_ratio);
    if (!more || !less) return {{NAN, NAN, NAN, NAN}};
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double slope = (identified_values(*more)[k] - identified_values(*less)[k]) /
                           (2.0 * step_ratio * values[k]);
      squares[k] += std::pow(slope * theta_ratios[static_cast<std::size_t>(i)], 2);
    }
  }
  IdentifiedDeviations deviations{
      {}, std::sqrt(squares[identified_time_constant]), std::sqrt(squares[identified_gain])};
  for (std::size_t k = 0; k < identified_parameters; ++k)
    deviations.parameters[k] = theta1_scaled ? NAN : std::sqrt(squares[k]);
  return deviations;
}

PhysicalParameters physical_parameters(const KnownMuscle& known) {
  PhysicalParameters muscle;
  for (std::size_t i = 0; i < physical_ranges.size(); ++i)
    muscle.*physical_ranges[i].member = known[i];
  return muscle;
}

IdentifiedDeviations identified_deviations(const KnownMuscle& known) {
  std::array<double, 4> theta_ratios{};
  for (std::size_t i = 0; i < theta_ratios.size(); ++i)
    theta_ratios[i] = known[known_theta1_deviation + i];
  return identified_deviations(physical_parameters(known), theta_ratios);
}

std::array<std::pair<std::string, double>, identified_gain + 1> named_deviations(
    const IdentifiedDeviations& deviations) {
  const std::string ending = "_deviation_ratio";
  std::array<std::pair<std::string, double>, identified_gain + 1> named;
  for (std::size_t i = 0; i < identified_parameters; ++i)
    named[i] = {physical_ranges[i].name + ending, deviations.parameters[i]};
  named[identified_time_constant] = {"time_constant" + ending, deviations.time_constant};
  named[identified_gain] = {"gain" + ending, deviations.gain};
  return named;
}

}  // namespace supercoil::operating
