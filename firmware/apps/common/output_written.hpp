// Whether everything that a program printed was written.
#pragma once

#include <cstdio>

namespace supercoil {

/// At the end of a program: a full disk or a closed pipe may have refused any earlier part of what
/// was printed, and the last flush succeeds all the same.
inline bool output_written() {
  return std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
}

}  // namespace supercoil
