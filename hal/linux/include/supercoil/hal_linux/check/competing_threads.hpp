// Other programs that the scheduler prefers to the loop.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "supercoil/hal/board_check.hpp"
#include "supercoil/hal_linux/check/loop_thread_settings.hpp"
#include "supercoil/hal_linux/machine.hpp"

namespace supercoil::hal_linux {

/// One thread as in /proc/PID/task/TID/stat.
struct ThreadStat {
  std::string name;
  bool of_kernel = false;
  int policy = 0;    ///< SCHED_OTHER …
  int priority = 0;  ///< 1 to 99 in SCHED_FIFO and SCHED_RR, else 0
};

/// Nothing when the line is not one.
std::optional<ThreadStat> parse_thread_stat(std::string_view line);

/// Threads of other programs above the loop's priority, or with deadlines. The kernel's own are
/// counted only: they are short and indispensable.
void check_competing_threads(const Machine& machine, const LoopThreadSettings& settings,
                             const hal::FindingSink& sink);

}  // namespace supercoil::hal_linux
