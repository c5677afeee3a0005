#include "supercoil/control/actuator/parameters.hpp"

#include <array>

namespace supercoil::control {

std::optional<Violation> check(const PhysicalParameters& p) {
  const std::array<Violation, 6> rules{{
      {"thermal_mass_J_per_K", p.thermal_mass_J_per_K, 1e-4, 1e3},
      {"heat_transfer_W_per_K", p.heat_transfer_W_per_K, 1e-5, 1e3},
      {"stiffness_N_per_m", p.stiffness_N_per_m, 1e-2, 1e6},
      {"damping_Ns_per_m", p.damping_Ns_per_m, 1e-4, 1e5},
      {"moving_mass_kg", p.moving_mass_kg, 1e-5, 1e3},
      {"force_per_kelvin_N_per_K", p.force_per_kelvin_N_per_K, 1e-6, 1e3},
  }};
  for (const Violation& rule : rules) {
    // Written so that a NaN fails.
    if (!(rule.value >= rule.lowest && rule.value <= rule.highest)) return rule;
  }
  return std::nullopt;
}

}  // namespace supercoil::control
