// The unit of a detector's margin.
#pragma once

#include <string>
#include <string_view>

#include "supervisor/fault.hpp"

namespace supercoil {

/// Of the measured value and the limit, as on the fault's page (docs/faults); empty: a count or a
/// flag.
constexpr std::string_view margin_unit(Fault fault) {
  switch (fault) {
    case Fault::sensor_out_of_range:
    case Fault::sensor_jump:
    case Fault::heater_not_responding:
    case Fault::over_travel:
    case Fault::muscle_loose:
      return "m";
    case Fault::sensor_frozen:
    case Fault::telemetry_dead:
    case Fault::command_timeout:
    case Fault::bus_off:
    case Fault::bus_error_passive:
    case Fault::controller_invalid:
      return "s";
    case Fault::heater_open:
    case Fault::heater_short:
    case Fault::heater_stuck_on:
      return "A";
    case Fault::under_voltage:
    case Fault::over_voltage:
      return "V";
    case Fault::sensors_disagree:
      return "K";
    case Fault::over_temperature:
      return "C";
    case Fault::energy_budget_exceeded:
      return "J";
    case Fault::resistance_drift:
      return "Ohm";
    case Fault::power_limit_exceeded:
      return "W";
    case Fault::duty_wrong:
      return "steps";
    default:
      return "";
  }
}

/// " C", to append to a number.
inline std::string margin_unit_after(Fault fault) {
  const std::string_view unit = margin_unit(fault);
  return unit.empty() ? std::string() : " " + std::string(unit);
}

}  // namespace supercoil
