// Checks a board's devices, one kind after the other, while everything is off.
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

/// Mean total time of all devices on a bus, by the bus's name; only for buses whose devices are all
/// present.
using BusTimes = std::map<std::string, hal::Duration>;

/// Compares the configuration's time for each bus with the measured one, and both with a tick.
void check_buses(const config::BoardConfig& config, const BusTimes& measured,
                 const hal::FindingSink& sink);

/// Judges what an enable line does when the firmware dies. found: the line while undriven.
hal::Finding assess(const std::string& what, const hal_linux::UndrivenLine& found);

/// Releases each enable line for a moment to see its level, if its channel's duty is certainly 0,
/// and takes it again.
void check_lines(const config::BoardWiring& wiring, const hal_linux::Machine& machine,
                 linux_board::Parts& parts, int priority, const hal::FindingSink& sink);

/// Bus time of one access to a device; empty when that is not known.
struct BusShare {
  std::string bus;
  std::optional<hal::Duration> time;
};

/// Adds the shares of buffered devices.
void check_pwms(const config::BoardWiring& wiring, linux_board::Parts& parts, int priority,
                const hal::FindingSink& sink, std::vector<BusShare>& shares);

/// Reads all converters in 50 ticks. Adds the shares of buffered ones.
void check_converters(const config::BoardConfig& config, const hal_linux::Machine& machine,
                      linux_board::Parts& parts, int priority, const hal::FindingSink& sink,
                      std::vector<BusShare>& shares);

/// Checks lines, PWM and converters, in this order. The caller holds the board's lock. Takes some
/// 50 ticks. priority: for the timed calls.
BusTimes check_devices(const config::BoardConfig& config, const hal_linux::Machine& machine,
                       int priority, const hal::FindingSink& sink);

}  // namespace supercoil::doctor
