// Whether the hardware watchdog is there, without opening it: opening would start it.
#pragma once

#include <string>

#include "supercoil/hal/board_check.hpp"
#include "supercoil/hal_linux/machine.hpp"

namespace supercoil::hal_linux {

/// path: its device, e.g. /dev/watchdog. in_use: supercoild runs, so the watchdog does too.
void check_watchdog(const Machine& machine, const std::string& path, bool in_use,
                    const hal::FindingSink& sink);

}  // namespace supercoil::hal_linux
