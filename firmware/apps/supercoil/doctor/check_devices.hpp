// Looks at a board's devices, one kind after the other, while everything is off.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "supercoil/hal/board_check.hpp"
#include "supercoil/hal/clock.hpp"
#include "supercoil/hal_linux/gpio_line.hpp"
#include "supercoil/hal_linux/machine.hpp"

#include "config/board_config.hpp"
#include "config/wiring.hpp"
#include "linux_board/parts.hpp"

namespace supercoil::doctor {

/// How long all devices of a bus took together, on average; only of buses whose devices are all
/// there. By the bus's name.
using BusTimes = std::map<std::string, hal::Duration>;

/// Compares what the configuration makes of each bus with what was measured, and both with a tick.
void check_buses(const config::BoardConfig& config, const BusTimes& measured,
                 const hal::FindingSink& sink);

/// What becomes of an enable line when the firmware dies. found: the line while nobody drives it.
hal::Finding judged(const std::string& what, const hal_linux::UndrivenLine& found);

/// Gives each enable line up for a moment to see what it is then, if its channel's duty is 0 for
/// certain, and takes it again.
void check_lines(const config::BoardWiring& wiring, const hal_linux::Machine& machine,
                 linux_board::Parts& parts, int priority, const hal::FindingSink& sink);

/// What one access to a device took of its bus's time; nothing when that is not known.
struct BusShare {
  std::string bus;
  std::optional<hal::Duration> time;
};

/// Adds the buffered ones' shares.
void check_pwms(const config::BoardWiring& wiring, linux_board::Parts& parts, int priority,
                const hal::FindingSink& sink, std::vector<BusShare>& shares);

/// Reads all of them in 50 ticks. Adds the buffered ones' shares.
void check_converters(const config::BoardConfig& config, const hal_linux::Machine& machine,
                      linux_board::Parts& parts, int priority, const hal::FindingSink& sink,
                      std::vector<BusShare>& shares);

/// Lines, PWM and converters, in this order. The caller holds the board's lock. Takes some 50
/// ticks. priority: of the calls that are timed.
BusTimes check_devices(const config::BoardConfig& config, const hal_linux::Machine& machine,
                       int priority, const hal::FindingSink& sink);

}  // namespace supercoil::doctor
