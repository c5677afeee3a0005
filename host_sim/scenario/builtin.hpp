// The scenarios that come with the program.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace supercoil::host_sim {

struct BuiltinScenario {
  std::string_view name;
  std::string_view text;  ///< TOML; its first line is a comment that says what it shows
};

const std::vector<BuiltinScenario>& builtin_scenarios();
/// The text of the scenario with this name.
std::optional<std::string_view> builtin_scenario(std::string_view name);
std::vector<std::string> names_of(const std::vector<BuiltinScenario>& entries);
/// The comment on its first line.
std::string_view description(const BuiltinScenario& scenario);

}  // namespace supercoil::host_sim
