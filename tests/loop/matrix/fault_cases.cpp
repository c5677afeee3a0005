#include "loop/matrix/fault_case.hpp"

namespace supercoil::test {

namespace {

using enum Situation;
using host_sim::ConverterTrouble;

const std::vector<Situation> cold{disarmed, arming, armed, calibrate, fault};
const std::vector<Situation> none{};
/// Everywhere but where a probe runs at a known moment.
const std::vector<Situation> not_probing{disarmed, armed,    pi,        pd_ff, mrac,
                                         power,    identify, calibrate, fault};

void position(Rig& rig, const ConverterTrouble& trouble) {
  rig.muscle().position.set(trouble);
}
void resistance(Rig& rig, double resistance_Ohm) {
  host_sim::MuscleChannelSettings settings = rough_board().board.channels[0];
  settings.resistance_Ohm = resistance_Ohm;
  rig.muscle().set(settings);
}
void load(Rig& rig, double load_N) {
  host_sim::MuscleChannelSettings settings = rough_board().board.channels[0];
  settings.load_N = load_N;
  rig.muscle().set(settings);
}
void every_tick(Rig& rig, std::function<void()> what) {
  rig.before_tick = std::move(what);
}
void nothing_more(Rig& rig) {
  rig.before_tick = [] {};
}

std::vector<FaultCase> sensors() {
  return {
      {Fault::sensor_out_of_range,
       {0.005},
       none,
       "",
       [](Rig& r) { position(r, {.loose = true}); },
       [](Rig& r) { position(r, {}); }},
      {Fault::sensor_stale,
       {0.010},
       none,
       "",
       [](Rig& r) { position(r, {.silent = true}); },
       [](Rig& r) { position(r, {}); }},
      {Fault::sensor_frozen,
       {1.0},
       cold,
       "a cold muscle's sensor may rest",
       [](Rig& r) { position(r, {.frozen = true}); },
       [](Rig& r) { position(r, {}); }},
      {Fault::sensor_jump,
       {0.0},
       none,
       "",
       [](Rig& r) { position(r, {.offset = 0.008}); },
       [](Rig& r) { position(r, {}); }},
      {Fault::sensors_disagree,
       {2.2},
       cold,
       "without current the resistance is not known",
       [](Rig& r) { resistance(r, 12.5); },
       [](Rig& r) { resistance(r, 10.0); }},
  };
}

std::vector<FaultCase> heater() {
  return {
      {Fault::heater_open,
       {0.05},
       {disarmed, armed, calibrate, fault},
       "no duty is given",
       [](Rig& r) { r.muscle().trouble.wire_open = true; },
       [](Rig& r) { r.muscle().trouble.wire_open = false; }},
      {Fault::heater_short,
       {0.01},
       {disarmed, armed, calibrate, fault},
       "no duty is given",
       [](Rig& r) { r.muscle().trouble.short_Ohm = 0.5; },
       [](Rig& r) { r.muscle().trouble.short_Ohm = 0.0; }},
      {Fault::heater_stuck_on,
       {0.05},
       none,
       "",
       [](Rig& r) { r.muscle().trouble.switch_stuck_on = true; },
       [](Rig& r) { r.muscle().trouble.switch_stuck_on = false; },
       [](RigSettings&) {},
       // More than was asked for looks like a short at first; when it goes on after the channel was
       // made safe, the board cuts the supply.
       [](Situation s) {
         return s == disarmed || s == armed || s == calibrate ? Fault::heater_stuck_on
                                                              : Fault::heater_short;
       }},
      {Fault::heater_not_responding,
       {40.0},
       cold,
       "no power, no motion to expect",
       [](Rig& r) { r.muscle().trouble.slack = true; },
       [](Rig& r) { r.muscle().trouble.slack = false; },
       // Where resistance tells the temperature, `sensors_disagree` is faster.
       [](RigSettings& s) { s.firmware.channels[0].heater.temperature_coefficient_per_K = 0.0; }},
      {Fault::duty_wrong,
       {0.005},
       none,
       "",
       [](Rig& r) { r.muscle().pwm.reads_wrong = true; },
       [](Rig& r) { r.muscle().pwm.reads_wrong = false; }},
      {Fault::line_failed,
       {0.0},
       none,
       "",
       [](Rig& r) { r.board.heartbeat.refuses = hal::Status::io_error; },
       [](Rig& r) { r.board.heartbeat.refuses = hal::Status::ok; }},
  };
}

std::vector<FaultCase> muscle_and_supply() {
  const std::vector<Situation> not_asked{disarmed, arming, armed, identify, calibrate, fault};
  const std::vector<Situation> no_surplus{disarmed, arming,   armed,     pi,
                                          pd_ff,    identify, calibrate, fault};
  return {
      {Fault::over_temperature,
       {5.0},
       not_asked,
       "nothing asks for more heat",
       [](Rig& r) { r.scale = 2.0; },
       [](Rig& r) { r.scale = 1.0; },
       [](RigSettings& s) {
         s.firmware.channels[0].supervision.trip_C = 85.0;
         s.firmware.channels[0].supervision.max_travel_m = 0.042;
         s.firmware.channels[0].thermal.boot_rise_K = 20.0;
       }},
      {Fault::over_travel,
       {0.3},
       none,
       "",
       [](Rig& r) { load(r, -0.45); },
       [](Rig& r) { load(r, 0.0); }},
      {Fault::energy_budget_exceeded,
       {15.0},
       not_asked,
       "nothing asks for more heat",
       [](Rig& r) { r.scale = 1.6; },
       [](Rig& r) { r.scale = 1.0; },
       [](RigSettings& s) {
         s.firmware.channels[0].supervision.energy_J = 22.0;
         s.firmware.channels[0].supervision.energy_window_s = 10.0;
       }},
      {Fault::resistance_drift,
       {0.05},
       not_probing,
       "measured by the probe while cold",
       [](Rig& r) { resistance(r, 17.0); },
       [](Rig& r) { resistance(r, 10.0); }},
      {Fault::under_voltage,
       {0.02},
       none,
       "",
       [](Rig& r) { r.board.set_supply_V(10.0); },
       [](Rig& r) { r.board.set_supply_V(12.0); }},
      {Fault::over_voltage,
       {0.02},
       none,
       "",
       [](Rig& r) { r.board.set_supply_V(14.5); },
       [](Rig& r) { r.board.set_supply_V(12.0); }},
      {Fault::power_limit_exceeded,
       {1.5},
       no_surplus,
       "nothing asks for power, or the controller takes the surplus back",
       [](Rig& r) {
         r.scale = 1.4;
         resistance(r, 5.3);
       },
       [](Rig& r) { resistance(r, 10.0); },
       [](RigSettings& s) {
         // The measured resistance lags: else the power stage corrects itself within 0.2 s.
         s.firmware.channels[0].heater.resistance_filter_s = 10.0;
         s.firmware.channels[0].supervision.resistance_part = 0.9;
         s.firmware.channels[0].heater.temperature_coefficient_per_K = 0.0;
         s.firmware.channels[0].limiter.max_W = 4.0;
         s.firmware.channels[0].supervision.max_measured_W = 4.4;
         s.firmware.channels[0].supervision.max_travel_m = 0.042;
       }},
  };
}

std::vector<FaultCase> time_and_bus() {
  return {
      {Fault::overrun,
       {0.0, 12},
       none,
       "",
       [](Rig& r) { every_tick(r, [&r] { r.board.lose_in_tick(1.5 * r.period_s()); }); },
       nothing_more},
      {Fault::tick_late,
       {0.0, 6},
       none,
       "",
       [](Rig& r) { every_tick(r, [&r] { r.board.oversleep(0.8 * r.period_s()); }); },
       nothing_more},
      {Fault::telemetry_dead,
       {0.5},
       none,
       "",
       [](Rig& r) { r.telemetry_lives = false; },
       [](Rig& r) { r.telemetry_lives = true; }},
      {Fault::bus_off,
       {0.0},
       none,
       "",
       [](Rig& r) { r.loop.health().bus.store(hal::CanState::bus_off); },
       [](Rig& r) { r.loop.health().bus.store(hal::CanState::active); }},
      {Fault::bus_error_passive,
       {1.0},
       none,
       "",
       [](Rig& r) { r.loop.health().bus.store(hal::CanState::error_passive); },
       [](Rig& r) { r.loop.health().bus.store(hal::CanState::active); }},
  };
}

std::vector<FaultCase> commands_and_self() {
  const std::vector<Situation> cold_or_own{disarmed, arming,    armed, power,
                                           identify, calibrate, fault};
  return {
      {Fault::command_timeout,
       {0.25},
       {disarmed, arming, armed, fault},
       "nothing is asked for",
       [](Rig& r) { r.commands_flow = false; },
       [](Rig& r) { r.commands_flow = true; }},
      {Fault::command_damaged,
       {0.0, 11},
       none,
       "",
       [](Rig& r) {
         r.commands_flow = false;
         every_tick(r, [&r] { r.loop.send_damaged(0); });
       },
       nothing_more},
      {Fault::command_not_allowed,
       {0.0, 11},
       none,
       "",
       [](Rig& r) {
         r.commands_flow = false;
         // Arming where that is done, heating where it is not.
         every_tick(r, [&r] {
           r.send(r.state() == State::disarmed || r.state() == State::fault ? Verb::rest
                                                                            : Verb::arm);
         });
       },
       nothing_more},
      {Fault::emergency_stop,
       {0.0},
       none,
       "",
       [](Rig& r) { r.board.stop_circuit.level.high = false; },
       [](Rig& r) {
         r.board.stop_circuit.level = {true, hal::Status::ok};
       }},
      {Fault::configuration_invalid,
       {0.0},
       none,
       "",
       [](Rig& r) { r.loop.health().configuration_changed.store(true); },
       [](Rig& r) { r.loop.health().configuration_changed.store(false); }},
      {Fault::controller_invalid,
       {3.0},
       cold_or_own,
       "no controller is at work",
       [](Rig& r) { r.scale = 2.5; },
       [](Rig& r) { r.scale = 1.0; },
       [](RigSettings& s) {
         s.firmware.channels[0].limiter.max_W = 3.0;
         s.firmware.channels[0].supervision.saturated_s = 1.0;
         s.firmware.channels[0].supervision.max_travel_m = 0.055;
         s.firmware.channels[0].supervision.highest_position_m = 0.06;
       }},
  };
}

}  // namespace

const std::vector<FaultCase>& fault_cases() {
  static const std::vector<FaultCase> all = [] {
    std::vector<FaultCase> cases;
    for (const auto& group :
         {sensors(), heater(), muscle_and_supply(), time_and_bus(), commands_and_self()}) {
      cases.insert(cases.end(), group.begin(), group.end());
    }
    return cases;
  }();
  return all;
}

}  // namespace supercoil::test
