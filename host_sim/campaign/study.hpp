// A campaign's study as its author wrote it: what is drawn for each run, and what must come out.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tl/expected.hpp>
#include <toml++/toml.h>

#include "campaign/distribution.hpp"
#include "campaign/sampler.hpp"
#include "compare/document.hpp"
#include "config/diagnostics.hpp"
#include "runner/summary.hpp"
#include "scenario/builtin.hpp"

namespace supercoil::host_sim::campaign {

inline constexpr std::int64_t max_runs = 1'000'000;

/// [[draw]]: a different value in every run.
struct Draw {
  std::string name;               ///< in tables
  std::vector<std::string> keys;  ///< scenario keys that get it; none: only other draws refer to it
  Distribution distribution;
  toml::array values;              ///< of a list
  std::vector<std::string> times;  ///< draws and keys that multiply the drawn value
  std::vector<std::string> over;   ///< and those that divide it
  std::string group;               ///< draws of one group are correlated; empty: no group
  double correlation = 1.0;        ///< with its group, in ranks of a normal distribution
};

/// [goals]: the maximum of a quantity; above it, the run has failed.
struct Goal {
  std::size_t quantity;  ///< of `quantities`
  double max;
};

struct Study {
  std::string name;
  std::string about;  ///< the comment on its first line
  std::int64_t runs = 1000;
  Sampling sampling = Sampling::sobol;
  std::uint64_t seed = 1;
  /// Run until the share of failures is known to ± this, with 95 % confidence; 0: all runs.
  double known_to = 0.0;
  Window window;         ///< of tracking
  std::string base;      ///< the scenario's name or file
  toml::table scenario;  ///< base, with the study's changes, without draws
  std::vector<Draw> draws;
  std::vector<compare::Document> contenders;  ///< one without text: the scenario's own controller
  std::vector<Goal> goals;
  std::uint32_t definition = 0;  ///< checksum of all that a run depends on
};

/// The studies that come with the program.
const std::vector<BuiltinScenario>& builtin_studies();

/// path: a .toml file, or the name of a built-in study. runs: replaces the study's; 0: keeps it.
/// The error is everything that is wrong with the study. keys: gets all keys of the study, without
/// those of its scenario, if not null.
tl::expected<Study, Errors> read_study(const std::string& path, std::int64_t runs = 0,
                                       config::KeyList* keys = nullptr);

}  // namespace supercoil::host_sim::campaign
