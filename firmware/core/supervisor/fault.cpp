#include "supervisor/fault.hpp"

namespace supercoil {

const std::array<FaultInfo, 32>& all_faults() {
  using enum Fault;
  static constexpr Scope channel = Scope::channel;
  static constexpr Scope board = Scope::board;
  static constexpr std::array<FaultInfo, 32> faults{{
      {sensor_out_of_range, "sensor_out_of_range", "sensors", channel,
       "a reading lies outside what the sensor can give"},
      {sensor_stale, "sensor_stale", "sensors", channel, "no fresh reading within the allowed age"},
      {sensor_frozen, "sensor_frozen", "sensors", channel,
       "the reading shows less than its own noise while the muscle is hot"},
      {sensor_jump, "sensor_jump", "sensors", channel,
       "the position changed faster than a muscle can move"},
      {sensors_disagree, "sensors_disagree", "sensors", channel,
       "resistance and position disagree"},
      {heater_open, "heater_open", "heater", channel, "duty, but no current"},
      {heater_short, "heater_short", "heater", channel, "more current than the muscle can draw"},
      {heater_stuck_on, "heater_stuck_on", "heater", board, "current although the channel is off"},
      {heater_not_responding, "heater_not_responding", "heater", channel,
       "power is applied and the muscle does not move as it should"},
      {duty_wrong, "duty_wrong", "heater", channel,
       "the PWM reads back a different duty than was set, or refuses it"},
      {line_failed, "line_failed", "heater", board,
       "an enable line or the heartbeat cannot be set"},
      {over_temperature, "over_temperature", "muscle", channel,
       "the estimated temperature passed its limit"},
      {over_travel, "over_travel", "muscle", channel, "the position passed its limit"},
      {energy_budget_exceeded, "energy_budget_exceeded", "muscle", channel,
       "more energy within the window than the muscle is allowed"},
      {resistance_drift, "resistance_drift", "muscle", channel,
       "the cold resistance has drifted from its calibration: the silver is wearing off"},
      {muscle_loose, "muscle_loose", "muscle", channel,
       "a muscle of a joint pulls with all the power it is allowed, and the joint does not follow"},
      {under_voltage, "under_voltage", "supply", board, "the supply is below its limit"},
      {over_voltage, "over_voltage", "supply", board, "the supply is above its limit"},
      {power_limit_exceeded, "power_limit_exceeded", "supply", channel,
       "the measured power exceeds what may be asked for"},
      {overrun, "overrun", "time", board, "too many consecutive ticks overran"},
      {tick_late, "tick_late", "time", board, "a tick woke later than tolerated"},
      {telemetry_dead, "telemetry_dead", "time", board, "the telemetry thread has stopped"},
      {command_timeout, "command_timeout", "command", channel,
       "the command to heat was not renewed in time"},
      {command_damaged, "command_damaged", "command", channel,
       "commands with a wrong checksum or counter"},
      {command_not_allowed, "command_not_allowed", "command", channel,
       "a command that this state does not allow"},
      {emergency_stop, "emergency_stop", "command", board, "the emergency stop is pressed or open"},
      {bus_off, "bus_off", "bus", channel, "the CAN controller left the bus"},
      {bus_error_passive, "bus_error_passive", "bus", channel,
       "the CAN controller sees too many errors"},
      {node_conflict, "node_conflict", "bus", channel,
       "another board on the bus has a node of this one"},
      {configuration_invalid, "configuration_invalid", "self", board,
       "the configuration is invalid or changed while running"},
      {controller_invalid, "controller_invalid", "self", channel,
       "the controller's output is NaN, or stays saturated"},
      {self_test_failed, "self_test_failed", "self", board, "the self-test at start failed"},
  }};
  return faults;
}

std::optional<FaultInfo> info(Fault fault) {
  for (const FaultInfo& candidate : all_faults()) {
    if (candidate.fault == fault) return candidate;
  }
  return std::nullopt;
}

std::string_view name(Fault fault) {
  const auto found = info(fault);
  return found ? found->name : std::string_view("none");
}

}  // namespace supercoil
