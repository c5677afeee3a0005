// Every fault of a channel or a board: its stable number, its name, and what it does.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace supercoil {

/// Numbers never change and are never reused: logs, CAN and docs/faults refer to them.
enum class Fault : std::uint8_t {
  none = 0,
  // Sensors
  sensor_out_of_range = 10,
  sensor_stale = 11,
  sensor_frozen = 12,
  sensor_jump = 13,
  sensors_disagree = 14,
  // Heater
  heater_open = 20,
  heater_short = 21,
  heater_stuck_on = 22,
  heater_not_responding = 23,
  duty_wrong = 24,
  line_failed = 25,
  // Muscle
  over_temperature = 30,
  over_travel = 31,
  energy_budget_exceeded = 32,
  resistance_drift = 33,
  muscle_loose = 34,
  // Supply
  under_voltage = 40,
  over_voltage = 41,
  power_limit_exceeded = 42,
  // Time
  overrun = 50,
  tick_late = 51,
  telemetry_dead = 52,
  // Command
  command_timeout = 60,
  command_damaged = 61,
  command_not_allowed = 62,
  emergency_stop = 63,
  // Bus
  bus_off = 70,
  bus_error_passive = 71,
  node_conflict = 72,
  // Self
  configuration_invalid = 80,
  controller_invalid = 81,
  self_test_failed = 82,
};

/// What a fault makes safe.
enum class Scope : std::uint8_t {
  channel,  ///< the channel that has it: duty 0 and enable low
  board,    ///< every channel likewise, and the heartbeat stops: the charge pump opens the supply
};

/// What a fault's number stands for.
struct FaultInfo {
  Fault fault;
  std::string_view name;  ///< as in configurations, logs and the file's name under docs/faults
  std::string_view group;
  Scope scope;
  std::string_view meaning;  ///< one line
};

/// All faults except `none`, ordered by number.
const std::array<FaultInfo, 32>& all_faults();
/// Empty for `none` and for unknown numbers.
std::optional<FaultInfo> info(Fault fault);
/// "none" for none.
std::string_view name(Fault fault);

}  // namespace supercoil
