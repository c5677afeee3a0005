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
void tell_outside(const char* what, double found, double lowest, double highest,
                  const std::string& bounds, Operator& who) {
  if (found >= lowest && found <= highest) return;
  who.say("warning: " + std::string(what) + " = " + in_digits(found) + " lies outside " + bounds +
          ", " + in_digits(lowest) + " to " + in_digits(highest) +
          ": an answer to describe is wrong by more than its uncertainty, or the configured force "
          "per kelvin is");
}

void tell_bounds(const PhysicalParameters& m, const control::ThermalBounds& b, Operator& who) {
  tell_outside("thermal_mass_J_per_K", m.thermal_mass_J_per_K, b.min_mass_J_per_K,
               b.max_mass_J_per_K, "thermal.min_mass_J_per_K to max_mass_J_per_K", who);
  tell_outside("heat_transfer_W_per_K", m.heat_transfer_W_per_K, b.min_transfer_W_per_K,
               b.max_transfer_W_per_K, "thermal.min_transfer_W_per_K to max_transfer_W_per_K", who);
}

}  // namespace

nlohmann::ordered_json tell_identified(const KnownMuscle& known, const ChannelSettings& configured,
                                       Operator& who) {
  nlohmann::ordered_json found;
  const IdentifiedDeviations deviations = identified_deviations(known);
  for (std::size_t i = 0; i < physical_ranges.size(); ++i) {
    const control::PhysicalRange& range = physical_ranges[i];
    const double ratio = i < identified_parameters ? deviations.parameters[i] : NAN;
    found[range.name] = json_number(known[i]);
    const double in_file = configured.muscle.*range.member;
    if (std::abs(known[i] / in_file - 1.0) > float_rounding_ratio)
      who.say(std::string(range.name) + ": " + beside(known[i], in_file, "", ratio));
  }
  for (const auto& [name, ratio] : named_deviations(deviations))
    found[name] = json_number(ratio);
  if (std::isnan(known[known_theta1_deviation]) && !std::isnan(deviations.gain)) {
    who.say(
        "theta1 was kept: each of these depends on the file's values; time constant and gain do "
        "not");
  }
  const PhysicalParameters muscle = told_parameters(known);
  const IdentifiedValues now = identified_values(muscle);
  const IdentifiedValues in_file = identified_values(configured.muscle);
  who.say("time constant: " + beside(now[identified_time_constant],
                                     in_file[identified_time_constant], "s",
                                     deviations.time_constant));
  who.say("gain: " + beside(1e3 * now[identified_gain], 1e3 * in_file[identified_gain], "mm/W",
                            deviations.gain));
  tell_bounds(muscle, configured.thermal.bounds, who);
  for (std::size_t i = known_theta1_deviation; i <= known_unexplained_ratio; ++i)
    found[std::string(known_quantities[i])] = json_number(known[i]);
  who.say("unexplained by the linear model: " + in_digits(100.0 * known[known_unexplained_ratio]) +
          " %");
  return found;
}

}  // namespace supercoil::operating
