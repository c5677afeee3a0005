#include "supervisor/board_supervisor.hpp"

#include <cmath>

namespace supercoil {

BoardSupervisor::BoardSupervisor(const BoardSupervision& s, double step_s)
    : stop_(0.0),
      lines_(0.0),
      configuration_(0.0),
      self_test_(0.0),
      under_({s.lowest_supply_V, s.supply_s}, step_s),
      over_({s.highest_supply_V, s.supply_s}, step_s),
      late_in_a_row_(s.late_in_a_row),
      overruns_(s.overruns_in_a_row),
      telemetry_(s.telemetry_silence_s, step_s),
      bus_off_(s.bus_off_s, step_s),
      bus_passive_(s.bus_passive_s, step_s),
      late_s_(s.late_s),
      bus_off_s_(s.bus_off_s),
      bus_passive_s_(s.bus_passive_s) {}

Fault BoardSupervisor::step(const BoardEvidence& e) {
  using enum Fault;
  verdict_.begin();
  const bool closed = e.stop_circuit.status == hal::Status::ok && e.stop_circuit.high;
  verdict_.note(emergency_stop, stop_.step(closed ? 0.0 : 1.0), stop_.margin());
  // A supply that cannot be measured may be anything.
  const double supply_V = e.supply.present ? e.supply.value : std::nan("");
  verdict_.note(under_voltage, under_.step(supply_V), under_.margin());
  verdict_.note(over_voltage, over_.step(e.supply.present ? supply_V : 0.0), over_.margin());
  verdict_.note(overrun, overruns_.step(e.skipped), overruns_.margin());
  verdict_.note(tick_late, late_in_a_row_.step(e.late_s > late_s_), late_in_a_row_.margin());
  verdict_.note(telemetry_dead, telemetry_.step(e.telemetry_beats), telemetry_.margin());
  const bool off = e.bus == hal::CanState::bus_off || e.bus == hal::CanState::down;
  const bool passive = off || e.bus == hal::CanState::error_passive;
  const bool off_too_long = bus_off_.step(off);
  bus_off_margin_ = {bus_off_.held_s(), bus_off_s_, false, off};
  verdict_.note(bus_off, off_too_long, bus_off_margin_);
  const bool passive_too_long = bus_passive_.step(passive);
  bus_passive_margin_ = detectors::rising(bus_passive_.held_s(), bus_passive_s_);
  verdict_.note(bus_error_passive, passive_too_long, bus_passive_margin_);
  verdict_.note(line_failed, lines_.step(e.lines_ok ? 0.0 : 1.0), lines_.margin());
  verdict_.note(configuration_invalid, configuration_.step(e.configuration_changed ? 1.0 : 0.0),
                configuration_.margin());
  verdict_.note(self_test_failed, self_test_.step(e.self_test_failed ? 1.0 : 0.0),
                self_test_.margin());
  return verdict_.fault();
}

}  // namespace supercoil
