// Reads a whole candump log.
#pragma once

#include <string>
#include <vector>

#include "supercoil/hal/can_bus.hpp"
#include "supercoil/hal/error.hpp"

namespace supercoil::operating {

struct CanLogFile {
  std::vector<hal::CanFrame> frames;  ///< in file order; times are time_of_run's
  std::size_t foreign_lines = 0;      ///< frames that supercoil never sends
  std::string damage;                 ///< what is wrong with the first line that cannot be read
  std::size_t damaged_lines = 0;
  /// What was left out of a damaged log: for damaged_lines > 0.
  std::string damage_text() const {
    return damage + "; " + std::to_string(damaged_lines) +
           (damaged_lines == 1 ? " such line is skipped" : " such lines are skipped");
  }
  std::string goes_back;  ///< the first line that is much earlier than the one before; empty: none
};

/// Skips lines that cannot be read: a log with a truncated last line is still useful. The error
/// names the file: it cannot be read, or has no log line.
Result<CanLogFile> read_can_log(const std::string& path);

}  // namespace supercoil::operating
