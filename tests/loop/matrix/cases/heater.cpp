#include "loop/matrix/cases/cases.hpp"

namespace supercoil::test {

namespace {

using enum Situation;

const std::vector<Situation> without_duty{disarmed, armed, calibrate, fault};

/// Too much current looks like a short at first; when it goes on after the channel was made safe,
/// the board cuts the supply.
Fault first_of_stuck_on(Situation s) {
  const bool off = s == disarmed || s == armed || s == calibrate;
  return off ? Fault::heater_stuck_on : Fault::heater_short;
}

/// Where resistance tells the temperature, `sensors_disagree` is faster.
void constant_resistance(RigSettings& s) {
  s.firmware.channels[Rig::tested].heater.temperature_coefficient_per_K = 0.0;
  // At 10 kHz, 40 s would take as long as all other trials of that rate.
  if (s.firmware.rate_Hz > 1e3)
    s.firmware.channels[Rig::tested].supervision.responding_window_s = 5;
}

}  // namespace

std::vector<FaultCase> heater_cases() {
  return {
      {.fault = Fault::heater_open,
       .within = {0.05},
       .elsewhere = without_duty,
       .why_not = "no duty is given",
       .inject = [](Rig& r) { r.muscle().faults.wire_open = true; },
       .remove = [](Rig& r) { r.muscle().faults.wire_open = false; }},
      {.fault = Fault::heater_short,
       .within = {0.006},
       .elsewhere = without_duty,
       .why_not = "no duty is given",
       // In parallel with the muscle, a third of the min resistance.
       .inject = [](Rig& r) { r.muscle().faults.short_Ohm = 1.9; },
       .remove = [](Rig& r) { r.muscle().faults.short_Ohm = 0.0; }},
      {.fault = Fault::heater_stuck_on,
       .within = {0.054},
       .inject = [](Rig& r) { r.muscle().faults.switch_stuck_on = true; },
       .remove = [](Rig& r) { r.muscle().faults.switch_stuck_on = false; },
       .first = first_of_stuck_on},
      {.fault = Fault::heater_stuck_on,
       .how = "nobody measures the current",
       .within = {0.06},
       .inject = [](Rig& r) { r.muscle().current.set({.silent = true}); },
       .remove = [](Rig& r) { r.muscle().current.set({.silent = false}); },
       // The channel is cold as far as is known; when nothing can tell whether it is, the board
       // cuts the supply.
       .first = [](Situation) { return Fault::sensor_stale; }},
      {.fault = Fault::heater_not_responding,
       .within = {40.0},
       .elsewhere = cold,
       .why_not = "no power, no motion to expect",
       .inject = [](Rig& r) { r.muscle().faults.slack = true; },
       .remove = [](Rig& r) { r.muscle().faults.slack = false; },
       .tune = constant_resistance},
      {.fault = Fault::duty_wrong,
       .within = {0.005},
       .inject = [](Rig& r) { r.muscle().pwm.reads_wrong = true; },
       .remove = [](Rig& r) { r.muscle().pwm.reads_wrong = false; }},
      {.fault = Fault::duty_wrong,
       .how = "the PWM refuses",
       .within = {0.055},
       .elsewhere = {disarmed, armed, calibrate, fault},
       .why_not = "no other duty is set",
       .inject = [](Rig& r) { r.muscle().pwm.refuses = hal::Status::io_error; },
       .remove = [](Rig& r) { r.muscle().pwm.refuses = hal::Status::ok; }},
      {.fault = Fault::line_failed,
       .within = {0.0},
       .inject = [](Rig& r) { r.board.heartbeat.refuses = hal::Status::io_error; },
       .remove = [](Rig& r) { r.board.heartbeat.refuses = hal::Status::ok; }},
  };
}

}  // namespace supercoil::test
