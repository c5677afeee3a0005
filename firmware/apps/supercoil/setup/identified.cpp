#include "apps/supercoil/setup/identified.hpp"

#include <cmath>
#include <string>

#include <nlohmann/json.hpp>

#include "apps/supercoil/identified_deviations.hpp"
#include "apps/supercoil/setup/figures.hpp"

namespace supercoil::operating {

namespace {

using control::physical_ranges;
using control::PhysicalParameters;

/// One line if the file's bounds exclude what was found: the muscle's power is based on them.
void report_outside(const char* what, double found, double min_allowed, double max_allowed,
                    const std::string& bounds, Operator& user) {
  if (found >= min_allowed && found <= max_allowed) return;
  user.show(
      "warning: " + std::string(what) + " = " + in_digits(found) + " lies outside " + bounds +
      ", " + in_digits(min_allowed) + " to " + in_digits(max_allowed) +
      ": an answer to describe is wrong by more than its uncertainty, or the configured force "
      "per kelvin is");
}

void report_outside_bounds(const PhysicalParameters& m, const control::ThermalBounds& b,
                           Operator& user) {
  report_outside("thermal_mass_J_per_K", m.thermal_mass_J_per_K, b.min_mass_J_per_K,
                 b.max_mass_J_per_K, "thermal.min_mass_J_per_K to max_mass_J_per_K", user);
  report_outside("heat_transfer_W_per_K", m.heat_transfer_W_per_K, b.min_transfer_W_per_K,
                 b.max_transfer_W_per_K, "thermal.min_transfer_W_per_K to max_transfer_W_per_K",
                 user);
}

}  // namespace

nlohmann::ordered_json report_identified(const KnownMuscle& known,
                                         const ChannelSettings& configured, Operator& user) {
  nlohmann::ordered_json found;
  const IdentifiedDeviations deviations = identified_deviations(known);
  for (std::size_t i = 0; i < physical_ranges.size(); ++i) {
    const control::PhysicalRange& range = physical_ranges[i];
    const double ratio = i < identified_parameters ? deviations.parameters[i] : NAN;
    found[range.name] = json_number(known[i]);
    const double in_file = configured.muscle.*range.member;
    if (std::abs(known[i] / in_file - 1.0) > float_rounding_ratio)
      user.show(std::string(range.name) + ": " + beside(known[i], in_file, "", ratio));
  }
  for (const auto& [name, ratio] : named_deviations(deviations))
    found[name] = json_number(ratio);
  if (std::isnan(known[known_theta1_deviation]) && !std::isnan(deviations.gain)) {
    user.show(
        "theta1 was kept: each of these depends on the file's values; time constant and gain do "
        "not");
  }
  const PhysicalParameters muscle = physical_parameters(known);
  const IdentifiedValues now = identified_values(muscle);
  const IdentifiedValues in_file = identified_values(configured.muscle);
  user.show("time constant: " + beside(now[identified_time_constant],
                                       in_file[identified_time_constant], "s",
                                       deviations.time_constant));
  user.show("gain: " + beside(1e3 * now[identified_gain], 1e3 * in_file[identified_gain], "mm/W",
                              deviations.gain));
  report_outside_bounds(muscle, configured.thermal.bounds, user);
  for (std::size_t i = known_theta1_deviation; i <= known_unexplained_ratio; ++i)
    found[std::string(known_quantities[i])] = json_number(known[i]);
  user.show("unexplained by the linear model: " +
            in_digits(100.0 * known[known_unexplained_ratio]) + " %");
  return found;
}

}  // namespace supercoil::operating
