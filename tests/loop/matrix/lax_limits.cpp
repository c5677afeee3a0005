#include "loop/matrix/lax_limits.hpp"

namespace supercoil::test {

namespace {

using Loosen = std::function<void(RigSettings&)>;

constexpr double lax = 3.0;
constexpr double lax_below = 1.0 / lax;  ///< for lower limits

template <typename Number>
Loosen channel(Number ChannelSupervision::*limit, double times = lax) {
  return [limit, times](RigSettings& s) {
    Number& value = s.firmware.channels[Rig::tested].supervision.*limit;
    value = static_cast<Number>(value * times);
  };
}

template <typename Number>
Loosen board(Number BoardSupervision::*limit, double times = lax) {
  return [limit, times](RigSettings& s) {
    Number& value = s.firmware.supervision.*limit;
    value = static_cast<Number>(value * times);
  };
}

void older_positions(RigSettings& s) {
  s.firmware.channels[Rig::tested].position.max_age_s *= lax;
}
void older_currents(RigSettings& s) {
  s.firmware.channels[Rig::tested].heater.current.max_age_s *= lax;
}
void older_supplies(RigSettings& s) {
  s.firmware.supply.max_age_s *= lax;
}
/// A hold time of zero cannot be multiplied.
void bus_off_later(RigSettings& s) {
  s.firmware.supervision.bus_off_s = lax * s.firmware.step_s();
}
/// Nothing in the firmware, but the hardware that it counts on.
void slower_pump(RigSettings& s) {
  s.board.charge_pump_decay_s *= lax;
}

std::vector<LaxLimit> of_sensors() {
  using C = ChannelSupervision;
  const std::string wire_off = "a wire that is off reads 12 mm below zero, beyond any such limit";
  return {
      {"min_position", Fault::sensor_out_of_range, channel(&C::min_position_m), wire_off},
      {"max_position", Fault::sensor_out_of_range, channel(&C::max_position_m), wire_off},
      {"out_of_range_s", Fault::sensor_out_of_range, channel(&C::out_of_range_s)},
      {"position max_age_s", Fault::sensor_stale, older_positions},
      {"position_noise, frozen", Fault::sensor_frozen, channel(&C::position_noise_rms_m, lax_below),
       "a frozen reading does not move at all, and any noise is more"},
      {"frozen_s", Fault::sensor_frozen, channel(&C::frozen_s)},
      {"position_noise, jump", Fault::sensor_jump, channel(&C::position_noise_rms_m)},
      {"max_speed_m_per_s", Fault::sensor_jump, channel(&C::max_speed_m_per_s)},
      {"disagree_K", Fault::sensors_disagree, channel(&C::disagree_K)},
      {"disagree_s", Fault::sensors_disagree, channel(&C::disagree_s)},
  };
}

std::vector<LaxLimit> of_heater() {
  using C = ChannelSupervision;
  return {
      {"open_min_duty", Fault::heater_open, channel(&C::open_min_duty)},
      {"open_s", Fault::heater_open, channel(&C::open_s)},
      {"min_resistance", Fault::heater_short, channel(&C::min_resistance_Ohm, lax_below)},
      {"short_s", Fault::heater_short, channel(&C::short_s)},
      {"off_current, short", Fault::heater_short, channel(&C::off_current_A)},
      {"off_current, stuck on", Fault::heater_stuck_on, channel(&C::off_current_A),
       "a switch that is stuck conducts 1.2 A, and the limit becomes 0.15 A"},
      {"stuck_on_s", Fault::heater_stuck_on, channel(&C::stuck_on_s)},
      {"current max_age_s", Fault::heater_stuck_on, older_currents},
      {"responding_window_s", Fault::heater_not_responding, channel(&C::responding_window_s)},
      {"responding_ratio", Fault::heater_not_responding, channel(&C::responding_ratio, lax_below),
       "a muscle off its anchor moves its sensor by nothing but noise"},
      {"responding_min_m", Fault::heater_not_responding, channel(&C::responding_min_m),
       "every active situation expects more motion than 3 mm"},
      {"wrong_duty_s", Fault::duty_wrong, channel(&C::wrong_duty_s)},
  };
}

std::vector<LaxLimit> of_muscle() {
  using C = ChannelSupervision;
  return {
      {"trip_C", Fault::over_temperature, channel(&C::trip_C)},
      {"max_travel", Fault::over_travel, channel(&C::max_travel_m)},
      {"energy_J", Fault::energy_budget_exceeded, channel(&C::energy_J)},
      // A shorter window is laxer: energy leaves the account sooner.
      {"energy_window_s", Fault::energy_budget_exceeded, channel(&C::energy_window_s, lax_below)},
      {"resistance_ratio", Fault::resistance_drift, channel(&C::resistance_ratio)},
      {"max_measured_W", Fault::power_limit_exceeded, channel(&C::max_measured_W)},
      {"over_power_s", Fault::power_limit_exceeded, channel(&C::over_power_s)},
      {"command_timeout_s", Fault::command_timeout, channel(&C::command_timeout_s)},
      {"damaged_in_a_row", Fault::command_damaged, channel(&C::damaged_in_a_row)},
      {"refused_in_a_row", Fault::command_not_allowed, channel(&C::refused_in_a_row)},
      {"saturated_s", Fault::controller_invalid, channel(&C::saturated_s)},
  };
}

std::vector<LaxLimit> of_board() {
  using B = BoardSupervision;
  return {
      {"min_supply", Fault::under_voltage, board(&B::min_supply_V, lax_below)},
      {"max_supply", Fault::over_voltage, board(&B::max_supply_V)},
      {"supply_s, under", Fault::under_voltage, board(&B::supply_s)},
      {"supply_s, over", Fault::over_voltage, board(&B::supply_s)},
      {"supply max_age_s", Fault::under_voltage, older_supplies},
      {"late_s", Fault::tick_late, board(&B::late_s)},
      {"late_in_a_row", Fault::tick_late, board(&B::late_in_a_row)},
      {"overruns_in_a_row", Fault::overrun, board(&B::overruns_in_a_row)},
      {"telemetry_timeout_s", Fault::telemetry_dead, board(&B::telemetry_timeout_s)},
      {"bus_off_s, from 0", Fault::bus_off, bus_off_later},
      {"bus_error_passive_s", Fault::bus_error_passive, board(&B::bus_error_passive_s)},
      {"the pump's decay", Fault::emergency_stop, slower_pump},
  };
}

}  // namespace

const std::vector<LaxLimit>& lax_limits() {
  static const std::vector<LaxLimit> all = [] {
    std::vector<LaxLimit> limits;
    for (const auto& group : {of_sensors(), of_heater(), of_muscle(), of_board()})
      limits.insert(limits.end(), group.begin(), group.end());
    return limits;
  }();
  return all;
}

}  // namespace supercoil::test
