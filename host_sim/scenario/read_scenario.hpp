// Scenarios from TOML.
#pragma once

#include <string>
#include <vector>

#include <tl/expected.hpp>
#include <toml++/toml.h>

#include "config/diagnostics.hpp"
#include "scenario/scenario.hpp"

namespace supercoil::host_sim {

/// A scenario, or everything that is wrong with it.
using ScenarioOrProblems = tl::expected<Scenario, Errors>;

/// Whose power stage and position sensor a scenario is checked against: its own, or those of a
/// board that use_board() puts in their place.
enum class Hardware { scenarios, boards };

/// path: a .toml file, or the name of a built-in scenario.
/// learned: replaces [muscle] and [joint.antagonist_muscle].
/// keys: gets all keys that apply at the start, and the times of events, if not null.
ScenarioOrProblems read_scenario(const std::string& path, const LearnedMuscles& learned = {},
                                 Hardware hardware = Hardware::scenarios,
                                 config::KeyList* keys = nullptr);

/// The same from text; name: for messages.
ScenarioOrProblems parse_scenario(const std::string& text, const std::string& name,
                                  const LearnedMuscles& learned = {},
                                  Hardware hardware = Hardware::scenarios,
                                  config::KeyList* keys = nullptr);

/// Lays one document over another, like an event over what was before it: a table that names its
/// kind replaces the old one; other keys are merged into those that are there.
void apply_changes(toml::table& document, toml::table&& changes);

/// Takes [controller], [estimator] and [reference_model] out of a document and of its events, for a
/// contender that brings its own.
void erase_control(toml::table& document);

/// The same from a document.
ScenarioOrProblems scenario_from(toml::table document, const std::string& name,
                                 const LearnedMuscles& learned = {},
                                 Hardware hardware = Hardware::scenarios,
                                 config::KeyList* keys = nullptr);

}  // namespace supercoil::host_sim
