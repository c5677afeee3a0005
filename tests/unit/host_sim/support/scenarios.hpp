// Scenarios as text.
#pragma once

#include <string>

#include <CppUTest/TestHarness.h>

#include "scenario/read_scenario.hpp"

namespace supercoil::test {

/// Reads a scenario that must be valid.
inline host_sim::Scenario read(const std::string& text) {
  auto scenario = host_sim::parse_scenario(text, "s.toml");
  if (!scenario) FAIL(config::to_text(scenario.error()).c_str());
  return *scenario;
}

/// The problems that are reported for it.
inline std::string problems(const std::string& text) {
  const auto scenario = host_sim::parse_scenario(text, "s.toml");
  return scenario ? "in order" : config::to_text(scenario.error());
}

}  // namespace supercoil::test
