// The outcomes of a study, and the file that keeps them: runs.csv.
#pragma once

#include <atomic>
#include <compare>
#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>

#include "supercoil/hal/error.hpp"

#include "campaign/draws.hpp"
#include "campaign/outcome.hpp"
#include "campaign/study.hpp"

namespace supercoil::host_sim::campaign {

/// Which run it was.
struct Key {
  std::size_t run = 0;        ///< from 0
  std::size_t contender = 0;  ///< of the study

  friend auto operator<=>(const Key&, const Key&) = default;  // NOLINT(modernize-use-nullptr)
};

using Outcomes = std::map<Key, Outcome>;

/// Program, version and study that runs are of: "supercoil-sim 0.2.0 campaign NAME, definition
/// HEX".
std::string origin_of(const Study& study);

/// Reads and writes lines of runs.csv; equal outcomes give equal bytes.
class Lines {
 public:
  /// Both must outlive it.
  Lines(const Study& study, const Draws& draws) : study_(&study), draws_(&draws) {}

  std::string line(const Key& key, const Outcome& outcome) const;
  /// The whole file: what made it, the columns' names, all lines in order.
  void write(std::ostream& out, const Outcomes& outcomes) const;

  /// Adds a file's outcomes. True: the last line was incomplete, and is left out. A file of another
  /// version or study, a damaged line and two outcomes of one run are errors, which name the file
  /// and the line. An absent file has no outcomes.
  Result<bool> read(const std::filesystem::path& path, Outcomes& into) const;

 private:
  std::string head() const;
  /// run,contender and what was drawn.
  std::string begin_of(const Key& key) const;

  const Study* study_;
  const Draws* draws_;
};

/// Carries a run out; empty when it was given up because of stop. The outcome depends only on the
/// study and the key.
std::optional<Outcome> carry_out(const Study& study, const Draws& draws, const Key& key,
                                 const std::atomic<bool>& stop);

/// The largest ratio of a goal's quantity to its maximum; above 1: failed. Infinite for a missing
/// quantity, for a fault that is a failure, and for anything above a maximum of 0.
double severity(const Study& study, const Outcome& outcome);

}  // namespace supercoil::host_sim::campaign
