// The result of a run, and the file that keeps it: runs.csv.
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "supercoil/hal/error.hpp"

#include "compare/measure.hpp"

namespace supercoil::host_sim::compare {

/// Which run it was.
struct Key {
  std::string controller;
  std::string disturbance;
  std::string arithmetic;
  std::uint64_t seed = 0;

  friend auto operator<=>(const Key&, const Key&) = default;  // NOLINT(modernize-use-nullptr)
};

struct Result {
  std::uint32_t definition = 0;  ///< checksum of what made its scenario (Case)
  std::string fault;             ///< the first; empty without
  Values values{};

  /// Equal to the bit.
  bool same_as(const Result& other) const;
};

using Results = std::map<Key, Result>;

/// A line of runs.csv with its line break; equal results give equal bytes.
std::string to_line(const Key& key, const Result& result);
/// The whole file: what made it, the columns' names, all lines in order.
std::string to_file(const Results& results);

struct ReadResults {
  Results results;
  bool torn = false;  ///< the last line was incomplete, and is left out
};
/// A file of another version, a damaged line and two results for one run are errors, which name the
/// file and the line. An absent file has no results.
supercoil::Result<ReadResults> read_results(const std::filesystem::path& path);

/// Adds a file's results. The error names a run whose two results differ, or that was made with
/// another definition.
supercoil::Result<void> merge(Results& into, const Results& from, const std::string& name);

}  // namespace supercoil::host_sim::compare
