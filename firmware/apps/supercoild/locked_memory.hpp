// Memory that mlockall() locks.
#pragma once

#include <string>

#include "config/board_config.hpp"

namespace supercoil::daemon {

/// Keeps the heap from requesting more from the kernel than it needs, because all of it is locked.
/// Call first in main().
void limit_heap();

/// A line for `--check`: how much memory supercoild will lock on this board. The calling program's
/// size with libraries and heap stands in for supercoild's.
std::string describe_locked_memory(const config::BoardConfig& config);

}  // namespace supercoil::daemon
