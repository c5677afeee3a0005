// The commands of supercoil. Each returns the program's exit status: 0 done, 1 failed while
// running, 2 wrong input (nothing was written).
#pragma once

#include <limits>
#include <string>

namespace supercoil::operating {

inline constexpr int exit_done = 0;
inline constexpr int exit_failed = 1;
inline constexpr int exit_wrong_input = 2;

/// Prints the message to standard error and returns the status.
int fail(int status, const std::string& message);

struct LogOptions {
  std::string file;
  std::string out;                                           ///< empty: standard output
  double from_s = -std::numeric_limits<double>::infinity();  ///< relative to the fault
  double to_s = std::numeric_limits<double>::infinity();
  int channel = 0;  ///< from 1; 0: all
  bool damaged = false;
  bool summary = false;
};
int log_command(const LogOptions& options);

}  // namespace supercoil::operating
