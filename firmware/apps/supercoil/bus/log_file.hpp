// A candump log as a whole.
#pragma once

#include <string>
#include <vector>

#include "supercoil/hal/can_bus.hpp"
#include "supercoil/hal/error.hpp"

namespace supercoil::operating {

struct CanLogFile {
  std::vector<hal::CanFrame> frames;  ///< in the order of the file; times are time_of_run's
  std::size_t foreign_lines = 0;      ///< frames that supercoil never sends
  std::string damage;                 ///< what is wrong with the first line that cannot be read
  std::size_t damaged_lines = 0;
};

/// Reads what can be read: a log whose last line was cut off is still worth all others. The error
/// names the file: it cannot be read, or has no line of a log.
Result<CanLogFile> read_can_log(const std::string& path);

}  // namespace supercoil::operating
