#include "supervisor/board_supervisor.hpp"

#include <cmath>

namespace supercoil {

BoardSupervisor::BoardSupervisor(const BoardSupervision& s, double step_s)
    : under_({s.min_supply_V, s.supply_s}, step_s),
      over_({s.max_supply_V, s.supply_s}, step_s),
      late_in_a_row_(s.late_in_a_row),
      overruns_(s.overruns_in_a_row),
      telemetry_(s.telemetry_timeout_s, step_s),
      bus_off_(s.bus_off_s, step_s),
      bus_passive_(s.bus_error_passive_s, step_s),
      late_s_(s.late_s) {}

Fault BoardSupervisor::step(const BoardInputs& e) {
  using enum Fault;
  verdict_.begin();
  const bool closed = e.stop_circuit.status == hal::Status::ok && e.stop_circuit.high;
  verdict_.note(emergency_stop, stop_.step(!closed), stop_);
  // Without a measurement the supply is unknown; NaN trips under_voltage.
  const double supply_V = e.supply.present ? e.supply.value : std::nan("");
  verdict_.note(under_voltage, under_.step(supply_V), under_);
  verdict_.note(over_voltage, over_.step(e.supply.present ? supply_V : 0.0), over_);
  verdict_.note(overrun, overruns_.step(e.skipped), overruns_);
  verdict_.note(tick_late, late_in_a_row_.step(e.late_s > late_s_), late_in_a_row_);
  verdict_.note(telemetry_dead, telemetry_.step(e.telemetry_heartbeats), telemetry_);
  const bool off = e.bus == hal::CanState::bus_off || e.bus == hal::CanState::down;
  const bool passive = off || e.bus == hal::CanState::error_passive;
  verdict_.note(bus_off, bus_off_.step(off), bus_off_);
  verdict_.note(bus_error_passive, bus_passive_.step(passive), bus_passive_);
  verdict_.note(node_conflict, node_conflict_.step(e.node_conflict), node_conflict_);
  verdict_.note(line_failed, lines_.step(!e.lines_ok), lines_);
  verdict_.note(configuration_invalid, configuration_.step(e.configuration_changed),
                configuration_);
  verdict_.note(self_test_failed, self_test_.step(e.self_test_failed, e.self_test_cut), self_test_);
  return verdict_.fault();
}

}  // namespace supercoil
