// What mlockall() takes.
#pragma once

#include <string>

#include "config/board_config.hpp"

namespace supercoil::daemon {

/// The heap takes no more from the kernel than it needs, for all that it takes is locked. First of
/// all that a program does.
void limit_heap();

/// A line for `--check`: how much memory supercoild will lock on this board; the calling program
/// stands for its size with libraries and heap.
std::string describe_locked_memory(const config::BoardConfig& config);

}  // namespace supercoil::daemon
