// Scenarios from TOML.
#pragma once

#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "config/diagnostics.hpp"
#include "scenario/scenario.hpp"

namespace supercoil::host_sim {

/// A scenario, or everything that is wrong with it.
using ScenarioOrProblems = tl::expected<Scenario, std::vector<config::Problem>>;

/// path: a .toml file, or the name of a built-in scenario.
ScenarioOrProblems read_scenario(const std::string& path);

/// The same from text; name: how messages call it.
ScenarioOrProblems parse_scenario(const std::string& text, const std::string& name);

}  // namespace supercoil::host_sim
