#include <cstdio>

#include "supercoil/control/tracking/mrac_settings.hpp"

#include "cli/commands.hpp"
#include "scenario/builtin.hpp"

namespace supercoil::host_sim {

int list_command() {
  std::puts("Scenarios (supercoil-sim run NAME):");
  for (const BuiltinScenario& scenario : builtin_scenarios()) {
    std::printf("  %-14.*s %.*s\n", static_cast<int>(scenario.name.size()), scenario.name.data(),
                static_cast<int>(description(scenario).size()), description(scenario).data());
  }
  std::puts("\nController presets ([controller] kind = \"mrac\", preset = ...):");
  for (const auto& [name, text] : control::mrac_presets) {
    std::printf("  %-14.*s %.*s\n", static_cast<int>(name.size()), name.data(),
                static_cast<int>(text.size()), text.data());
  }
  std::puts(
      "\nReference models ([reference_model] kind = ...):\n"
      "  design         what the paper's text asks for: wn = 1 rad/s, < 5 % overshoot, q0 = 0.8\n"
      "  eq8            what the paper prints as Eq. (8): 40 % overshoot\n"
      "  wm16           16/((s+4)(s+5)(s+0.8)): the one that MRAC's proof needs\n"
      "  poles          three real poles: poles_rad_per_s = [a, b, c]");
  return exit_done;
}

}  // namespace supercoil::host_sim
