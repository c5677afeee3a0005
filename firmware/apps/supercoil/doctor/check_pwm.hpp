// Looks at a board's PWM outputs, duty 0.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "supercoil/hal/board_check.hpp"
#include "supercoil/hal/clock.hpp"

#include "config/wiring.hpp"
#include "linux_board/parts.hpp"

namespace supercoil::doctor {

/// What one access to a device took of its bus's time; nothing when that is not known.
struct BusShare {
  std::string bus;
  std::optional<hal::Duration> time;
};

/// Adds the buffered ones' shares.
void check_pwms(const config::BoardWiring& wiring, linux_board::Parts& parts, int priority,
                const hal::FindingSink& sink, std::vector<BusShare>& shares);

}  // namespace supercoil::doctor
