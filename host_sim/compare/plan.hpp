// The runs of a comparison.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "supercoil/hal/error.hpp"

#include "batch/kept_lines.hpp"
#include "scenario/scenario.hpp"

namespace supercoil::host_sim::compare {

/// Empty lists mean the built-in ones. A name with a dot or a slash is a scenario's file.
/// +SECONDS at the end of a disturbance's name delays its events and its end.
struct Selection {
  std::vector<std::string> controllers;
  std::vector<std::string> disturbances;
  std::vector<std::string> arithmetics;
  std::int64_t seeds = 20;  ///< seeds 1 to this
  batch::Shard shard;
};

/// The controllers and disturbances that an empty selection compares.
std::vector<std::string> default_controllers();
std::vector<std::string> default_disturbances();

/// A line of the table.
struct Case {
  std::string controller;
  std::string disturbance;
  std::string arithmetic;
  std::uint32_t definition;  ///< checksum of what makes its scenario
  Scenario scenario;         ///< for any seed
};

struct Run {
  std::size_t case_index;  ///< in the plan's cases
  std::uint64_t seed;
};

struct Plan {
  std::vector<Case> cases;
  std::vector<Run> runs;                ///< of the shard; all cases of a seed before the next seed
  std::vector<std::string> impossible;  ///< cases that are impossible, and why
};

/// The error lists all problems of the selection, one per line.
supercoil::Result<Plan> make_plan(const Selection& selection);

}  // namespace supercoil::host_sim::compare
