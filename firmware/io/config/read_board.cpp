#include "config/read_board.hpp"

#include <algorithm>

namespace supercoil::config {

namespace {

void read_time(Section& section, BoardSettings& settings) {
  BoardSupervision& s = settings.supervision;
  settings.rate_Hz = section.number("rate_Hz", settings.rate_Hz, {100.0, 10e3});
  const double tick_ms = 1e3 * settings.step_s();
  s.late_s = 1e-3 * section.number("late_ms", 0.5 * tick_ms, {1e-3, tick_ms});
  s.late_in_a_row = static_cast<int>(section.integer("late_in_a_row", s.late_in_a_row, 1, 1000));
  s.overruns_in_a_row =
      static_cast<int>(section.integer("overruns_in_a_row", s.overruns_in_a_row, 1, 100));
  // More than a second would not count as a cut.
  s.charge_pump_decay_s = 1e-3 * section.required_number("charge_pump_decay_ms", {0.1, 1000.0});
}

}  // namespace

void read_board(Section& section, BoardConfig& config) {
  BoardSupervision& s = config.settings.supervision;
  config.name = section.text("name", config.name);
  read_time(section, config.settings);
  s.telemetry_timeout_s =
      1e-3 * section.number("telemetry_timeout_ms", 1e3 * s.telemetry_timeout_s, {10.0, 60e3});
  s.bus_off_s = 1e-3 * section.number("can_bus_off_ms", 1e3 * s.bus_off_s, {0.0, 60e3});
  s.bus_error_passive_s =
      1e-3 * section.number("can_error_passive_ms", 1e3 * s.bus_error_passive_s, {0.0, 60e3});
  config.storage_folder = section.text("storage_folder", "/var/lib/supercoil");
  if (config.storage_folder.empty() || config.storage_folder.front() != '/') {
    section.wrong("storage_folder", "must be an absolute path");
  }
  Section watchdog = section.section("watchdog");
  if (section.has("watchdog")) {
    WatchdogAddress address;
    address.device = watchdog.text("device", "/dev/watchdog");
    address.timeout_s = watchdog.number("timeout_s", address.timeout_s, {1.0, 600.0});
    config.wiring.watchdog = address;
    watchdog.finish();
  }
  section.finish();
}

void read_lines(Section& section, WiringReader& reader, BoardWiring& wiring) {
  wiring.heartbeat = reader.line(section.section("heartbeat"), "the heartbeat");
  wiring.stop_circuit = reader.line(section.section("stop_circuit"), "the stop circuit");
  Section light = section.section("light");
  if (section.has("light")) wiring.light = reader.line(light, "the light");
  section.finish();
}

void read_supply(Section section, WiringReader& reader, BoardConfig& config) {
  BoardSettings& settings = config.settings;
  BoardSupervision& s = settings.supervision;
  config.wiring.supply = reader.converter(section, "the supply");
  settings.supply.scaling.per_count = section.required_number("V_per_count", {1e-9, 10.0});
  settings.supply.scaling.offset = section.number("offset_V", 0.0, {-100.0, 100.0});
  settings.supply.max_age_s = reader.max_age_s(section, config.wiring.supply);
  s.min_supply_V = section.required_number("min_V", {0.5, 60.0});
  s.max_supply_V = section.required_number("max_V", {0.5, 60.0});
  if (s.min_supply_V >= s.max_supply_V) {
    section.wrong("min_V", "must be less than max_V");
  }
  const double hold_s = std::max(s.supply_s, 3.0 * settings.step_s());
  s.supply_s = 1e-3 * section.number("hold_ms", 1e3 * hold_s, {1.0, 1000.0});
  section.finish();
}

board::AirSettings read_ambient(Section section, WiringReader& reader, BoardConfig& config) {
  board::AirSettings air;
  air.coldest_C = section.required_number("coldest_C", {-40.0, 80.0});
  air.warmest_C = section.required_number("warmest_C", {-40.0, 80.0});
  if (air.coldest_C > air.warmest_C) section.wrong("coldest_C", "must not exceed warmest_C");
  Section sensor = section.section("sensor");
  if (section.has("sensor")) {
    InputSettings& input = config.settings.air;
    config.wiring.air = reader.converter(sensor, "the air's sensor");
    input.scaling.per_count = sensor.required_number("C_per_count", {-10.0, 10.0});
    if (input.scaling.per_count == 0.0) sensor.wrong("C_per_count", "must not be 0");
    input.scaling.offset = sensor.number("offset_C", 0.0, {-1000.0, 1000.0});
    input.max_age_s = reader.max_age_s(sensor, *config.wiring.air);
    air.error_K = sensor.number("error_K", 2.0, {0.1, 20.0});
    sensor.finish();
  }
  section.finish();
  return air;
}

CommandRules read_command(Section section, double step_s) {
  const ChannelSupervision defaults;
  CommandRules rules{};
  const double min_ms = std::max(10.0, 2e3 * step_s);
  rules.timeout_s =
      1e-3 * section.number("timeout_ms", 1e3 * defaults.command_timeout_s, {min_ms, 5000.0});
  rules.damaged_in_a_row =
      static_cast<int>(section.integer("damaged_in_a_row", defaults.damaged_in_a_row, 1, 1000));
  rules.refused_in_a_row =
      static_cast<int>(section.integer("refused_in_a_row", defaults.refused_in_a_row, 1, 1000));
  section.finish();
  return rules;
}

}  // namespace supercoil::config
