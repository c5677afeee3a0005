// Exit status of every supercoil program.
#pragma once

namespace supercoil {

inline constexpr int exit_done = 0;
inline constexpr int exit_failed = 1;       ///< while it ran
inline constexpr int exit_wrong_input = 2;  ///< nothing was started or written

}  // namespace supercoil
