#include <array>
#include <cstdio>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "supercoil/control/tracking/mrac_settings.hpp"

#include "cli/commands.hpp"
#include "scenario/builtin.hpp"

namespace supercoil::host_sim {

namespace {

struct Named {
  std::string_view name;
  std::string_view description;
};

constexpr std::array reference_models{
    Named{"design", "specified in the paper's text: wn = 1 rad/s, < 5 % overshoot, q0 = 0.8"},
    Named{"eq8", "printed in the paper as Eq. (8): 40 % overshoot"},
    Named{"wm16", "16/((s+4)(s+5)(s+0.8)): the model that MRAC's proof needs"},
    Named{"poles", "three real poles: poles_rad_per_s = [a, b, c]"}};

struct Section {
  const char* key;
  const char* title;
  std::vector<Named> entries;
};

std::vector<Section> sections() {
  Section scenarios{"scenarios", "Scenarios (supercoil-sim run NAME):", {}};
  for (const BuiltinScenario& scenario : builtin_scenarios())
    scenarios.entries.push_back({scenario.name, description(scenario)});
  Section presets{
      "controller_presets", "Controller presets ([controller] kind = \"mrac\", preset = ...):", {}};
  for (const auto& [name, text] : control::mrac_presets)
    presets.entries.push_back({name, text});
  return {scenarios,
          presets,
          {"reference_models",
           "Reference models ([reference_model] kind = ...):",
           {reference_models.begin(), reference_models.end()}}};
}

}  // namespace

int list_command(bool as_json) {
  nlohmann::ordered_json json;
  const char* before = "";
  for (const Section& section : sections()) {
    auto& listed = json[section.key] = nlohmann::ordered_json::array();
    for (const auto& [name, text] : section.entries)
      listed.push_back({{"name", name}, {"description", text}});
    if (as_json) continue;
    std::printf("%s%s\n", before, section.title);
    before = "\n";
    for (const auto& [name, text] : section.entries) {
      std::printf("  %-14.*s %.*s\n", static_cast<int>(name.size()), name.data(),
                  static_cast<int>(text.size()), text.data());
    }
  }
  if (as_json) std::puts(json.dump(2).c_str());
  return exit_done;
}

}  // namespace supercoil::host_sim
