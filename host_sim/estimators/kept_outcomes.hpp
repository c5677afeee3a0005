// The file that keeps each outcome to the bit: runs.csv.
#pragma once

#include <filesystem>
#include <string>

#include "supercoil/hal/error.hpp"

#include "estimators/results.hpp"

namespace supercoil::host_sim::estimators {

/// A line with its line break.
std::string to_line(const Key& key, const Outcome& outcome);
/// The whole file: what made it, the columns' names, all lines in order.
std::string to_file(const Outcomes& outcomes);

struct ReadOutcomes {
  Outcomes outcomes;
  bool torn = false;  ///< the last line was incomplete, and is left out
};
/// A file of another version and a damaged line are errors, which name the file and the line. An
/// absent file has no outcomes.
Result<ReadOutcomes> read_outcomes(const std::filesystem::path& path);

}  // namespace supercoil::host_sim::estimators
