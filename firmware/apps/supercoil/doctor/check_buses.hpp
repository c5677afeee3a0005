// Whether the buses' threads are done in time.
#pragma once

#include <map>
#include <string>

#include "supercoil/hal/board_check.hpp"
#include "supercoil/hal/clock.hpp"

#include "config/board_config.hpp"

namespace supercoil::doctor {

/// How long all devices of a bus took together, on average; only of buses whose devices are all
/// there. By the bus's name.
using BusTimes = std::map<std::string, hal::Duration>;

/// Compares what the configuration makes of each bus with what was measured, and both with a tick.
void check_buses(const config::BoardConfig& config, const BusTimes& measured,
                 const hal::FindingSink& sink);

}  // namespace supercoil::doctor
