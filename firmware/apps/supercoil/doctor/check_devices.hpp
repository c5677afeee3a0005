// Looks at the devices that the configuration names.
#pragma once

#include "supercoil/hal/board_check.hpp"
#include "supercoil/hal_linux/machine.hpp"

#include "apps/supercoil/doctor/check_buses.hpp"
#include "config/board_config.hpp"

namespace supercoil::doctor {

/// Lines, PWM and converters, in this order. The caller holds the board's lock. Takes some 50
/// ticks. priority: of the calls that are timed.
BusTimes check_devices(const config::BoardConfig& config, const hal_linux::Machine& machine,
                       int priority, const hal::FindingSink& sink);

}  // namespace supercoil::doctor
