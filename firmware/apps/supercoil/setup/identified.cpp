#include "apps/supercoil/setup/identified.hpp"

#include <cmath>
#include <string>

#include <nlohmann/json.hpp>

#include "supercoil/control/actuator/conversions.hpp"

#include "apps/supercoil/setup/figures.hpp"

namespace supercoil::operating {

namespace {

using control::physical_ranges;
using control::PhysicalParameters;

/// Of theta, either way, by which its effect is measured.
constexpr double step_ratio = 1e-4;
/// What is found of a muscle: the parameters, its time constant and its gain.
constexpr std::size_t parameter_count = 4;
constexpr std::size_t time_constant_at = parameter_count;
constexpr std::size_t gain_at = time_constant_at + 1;
using Values = std::array<double, gain_at + 1>;

Values values_of(const PhysicalParameters& m) {
  return {m.thermal_mass_J_per_K, m.heat_transfer_W_per_K,           m.stiffness_N_per_m,
          m.damping_Ns_per_m,     -1.0 / m.thermal_pole_rad_per_s(), m.dc_gain_m_per_W()};
}

/// One line where the file's bounds exclude what was found: the muscle gets its power by them.
void tell_outside(const char* what, double found, double lowest, double highest,
                  const std::string& bounds, Operator& who) {
  if (found >= lowest && found <= highest) return;
  who.say(
      "warning: " + std::string(what) + " = " + in_digits(found) + " lies outside " + bounds +
      ", " + in_digits(lowest) + " to " + in_digits(highest) +
      ": an answer to describe was further off than its uncertainty, or the configured force per "
      "kelvin is");
}

void tell_bounds(const PhysicalParameters& m, const control::ThermalBounds& b, Operator& who) {
  tell_outside("thermal_mass_J_per_K", m.thermal_mass_J_per_K, b.min_mass_J_per_K,
               b.max_mass_J_per_K, "thermal.min_mass_J_per_K to max_mass_J_per_K", who);
  tell_outside("heat_transfer_W_per_K", m.heat_transfer_W_per_K, b.min_transfer_W_per_K,
               b.max_transfer_W_per_K, "thermal.min_transfer_W_per_K to max_transfer_W_per_K", who);
}

}  // namespace

IdentifiedDeviations identified_deviations(const PhysicalParameters& muscle,
                                           const std::array<double, 4>& theta_ratios) {
  const control::Theta theta = control::theta_from(muscle);
  const control::KnownParameters taken{muscle.force_per_kelvin_N_per_K, muscle.moving_mass_kg};
  const Values values = values_of(muscle);
  const bool theta1_scaled = std::isnan(theta_ratios[0]);
  Values squares{};
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
      const double slope =
          (values_of(*more)[k] - values_of(*less)[k]) / (2.0 * step_ratio * values[k]);
      squares[k] += std::pow(slope * theta_ratios[static_cast<std::size_t>(i)], 2);
    }
  }
  IdentifiedDeviations deviations{
      {}, std::sqrt(squares[time_constant_at]), std::sqrt(squares[gain_at])};
  for (std::size_t k = 0; k < parameter_count; ++k)
    deviations.parameters[k] = theta1_scaled ? NAN : std::sqrt(squares[k]);
  return deviations;
}

nlohmann::ordered_json tell_identified(const KnownMuscle& known, const ChannelSettings& configured,
                                       Operator& who) {
  nlohmann::ordered_json found;
  PhysicalParameters muscle;
  for (std::size_t i = 0; i < physical_ranges.size(); ++i) {
    muscle.*physical_ranges[i].member = known[i];
    found[physical_ranges[i].name] = json_number(known[i]);
  }
  std::array<double, parameter_count> theta_ratios{};
  for (std::size_t i = 0; i < theta_ratios.size(); ++i)
    theta_ratios[i] = known[known_theta1_deviation + i];
  const IdentifiedDeviations deviations = identified_deviations(muscle, theta_ratios);
  for (std::size_t i = 0; i < physical_ranges.size(); ++i) {
    const control::PhysicalRange& range = physical_ranges[i];
    const double ratio = i < parameter_count ? deviations.parameters[i] : NAN;
    if (i < parameter_count)
      found[std::string(range.name) + "_deviation_ratio"] = json_number(ratio);
    const double in_file = configured.muscle.*range.member;
    if (std::abs(known[i] / in_file - 1.0) > float_rounding_ratio)
      who.say(std::string(range.name) + ": " + beside(known[i], in_file, "", ratio));
  }
  const Values now = values_of(muscle);
  const Values in_file = values_of(configured.muscle);
  if (std::isnan(theta_ratios[0]) && !std::isnan(deviations.gain)) {
    who.say(
        "theta1 was kept: each of these rests on the file's values; time constant and gain do not");
  }
  who.say("time constant: " +
          beside(now[time_constant_at], in_file[time_constant_at], "s", deviations.time_constant));
  who.say("gain: " + beside(1e3 * now[gain_at], 1e3 * in_file[gain_at], "mm/W", deviations.gain));
  found["time_constant_deviation_ratio"] = json_number(deviations.time_constant);
  found["gain_deviation_ratio"] = json_number(deviations.gain);
  tell_bounds(muscle, configured.thermal.bounds, who);
  for (std::size_t i = known_theta1_deviation; i <= known_unexplained_ratio; ++i)
    found[std::string(known_quantities[i])] = json_number(known[i]);
  who.say("unexplained by the linear model: " + in_digits(100.0 * known[known_unexplained_ratio]) +
          " %");
  return found;
}

}  // namespace supercoil::operating
