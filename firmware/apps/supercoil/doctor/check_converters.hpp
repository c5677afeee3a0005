// Looks at what a board's converters give while everything is off.
#pragma once

#include <vector>

#include "supercoil/hal/board_check.hpp"
#include "supercoil/hal_linux/machine.hpp"

#include "apps/supercoil/doctor/check_pwm.hpp"
#include "config/board_config.hpp"
#include "linux_board/parts.hpp"

namespace supercoil::doctor {

/// Reads all of them in 50 ticks. Adds the buffered ones' shares.
void check_converters(const config::BoardConfig& config, const hal_linux::Machine& machine,
                      linux_board::Parts& parts, int priority, const hal::FindingSink& sink,
                      std::vector<BusShare>& shares);

}  // namespace supercoil::doctor
