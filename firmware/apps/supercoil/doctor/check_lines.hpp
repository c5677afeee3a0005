// Looks at a board's lines: whether they are there, how fast they are, and what cuts them.
#pragma once

#include <string>

#include "supercoil/hal/board_check.hpp"
#include "supercoil/hal_linux/gpio_line.hpp"

#include "config/wiring.hpp"
#include "linux_board/parts.hpp"

namespace supercoil::doctor {

/// What becomes of an enable line when the firmware dies. found: the line while nobody drives it.
hal::Finding judged(const std::string& what, const hal_linux::UndrivenLine& found);

/// Gives each enable line up for a moment to see what it is then, if its channel's duty is 0 for
/// certain, and takes it again.
void check_lines(const config::BoardWiring& wiring, const hal_linux::Machine& machine,
                 linux_board::Parts& parts, int priority, const hal::FindingSink& sink);

}  // namespace supercoil::doctor
