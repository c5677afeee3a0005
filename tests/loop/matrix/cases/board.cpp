// Supply, time and bus: what all channels have in common.

#include "loop/matrix/cases/cases.hpp"

namespace supercoil::test {

namespace {

std::function<void(Rig&)> supply(double supply_V) {
  return [supply_V](Rig& rig) { rig.board.set_supply_V(supply_V); };
}

std::function<void(Rig&)> bus(hal::CanState state) {
  return [state](Rig& rig) { rig.loop.health().bus.store(state); };
}

/// Every tick takes longer than its period.
void overrun(Rig& rig) {
  every_tick(rig, [&rig] { rig.board.lose_in_tick(1.5 * rig.period_s()); });
}

/// Every tick wakes late, but within its period.
void wake_late(Rig& rig) {
  every_tick(rig, [&rig] { rig.board.oversleep(0.8 * rig.period_s()); });
}

/// A simulated board that steps only at whole periods cannot wake the loop late.
void finer_steps(RigSettings& settings) {
  settings.board.substeps = 5;
}

}  // namespace

std::vector<FaultCase> board_cases() {
  const auto well = supply(12.0);
  const auto bus_well = bus(hal::CanState::active);
  return {
      {.fault = Fault::under_voltage, .within = {0.02}, .inject = supply(10.0), .remove = well},
      {.fault = Fault::under_voltage,
       .how = "nobody measures the supply",
       .within = {0.03},
       .inject = [](Rig& r) { r.board.supply.set({.silent = true}); },
       .remove = [](Rig& r) { r.board.supply.set({.silent = false}); }},
      {.fault = Fault::over_voltage, .within = {0.02}, .inject = supply(14.5), .remove = well},
      // Each tick takes two periods, and the fault needs five left out.
      {.fault = Fault::overrun, .within = {0.0, 12}, .inject = overrun, .remove = nothing_more},
      {.fault = Fault::tick_late,
       .within = {0.0, 6},
       .inject = wake_late,
       .remove = nothing_more,
       .tune = finer_steps},
      {.fault = Fault::telemetry_dead,
       .within = {0.5},
       .inject = [](Rig& r) { r.telemetry_lives = false; },
       .remove = [](Rig& r) { r.telemetry_lives = true; }},
      {.fault = Fault::bus_off,
       .within = {0.0},
       .inject = bus(hal::CanState::bus_off),
       .remove = bus_well},
      {.fault = Fault::bus_error_passive,
       .within = {1.0},
       .inject = bus(hal::CanState::error_passive),
       .remove = bus_well},
      {.fault = Fault::node_conflict,
       .within = {0.0},
       .inject = [](Rig& r) { r.loop.health().node_conflict.store(true); },
       .remove = [](Rig& r) { r.loop.health().node_conflict.store(false); }},
      {.fault = Fault::configuration_invalid,
       .within = {0.0},
       .inject = [](Rig& r) { r.loop.health().configuration_changed.store(true); },
       .remove = [](Rig& r) { r.loop.health().configuration_changed.store(false); }},
      {.fault = Fault::emergency_stop,
       .within = {0.0},
       .inject = [](Rig& r) { r.board.stop_circuit.level.high = false; },
       .remove = [](Rig& r) { r.board.stop_circuit.level.high = true; }},
  };
}

}  // namespace supercoil::test
