// How every supercoil program ends.
#pragma once

#include <cstdio>

namespace supercoil {

inline constexpr int exit_done = 0;
inline constexpr int exit_failed = 1;       ///< while it ran
inline constexpr int exit_wrong_input = 2;  ///< nothing was started or written

/// Whether all that was printed was written, at the end of a program: a full disk or a closed pipe
/// may have refused any earlier part, and the last flush succeeds all the same.
inline bool output_written() {
  return std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
}

}  // namespace supercoil
