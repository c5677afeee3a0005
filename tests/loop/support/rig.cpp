#include "loop/support/rig.hpp"

namespace supercoil::test {

namespace {

constexpr double coefficient_per_K = 0.002;
constexpr double sense_filter_s = 0.005;

control::ControllerSettings controller(control::ControllerKind kind) {
  control::ControllerSettings c;
  c.kind = kind;
  c.model = kind == control::ControllerKind::mrac ? control::wm16_model() : control::design_model();
  if (kind == control::ControllerKind::mrac) c.mrac = *control::mrac_preset("a");
  return c;
}

control::EstimatorSettings gradient() {
  control::EstimatorSettings e;
  const control::Theta& nominal = e.gradient.scale.nominal;
  e.gradient.initial = nominal * 0.7;
  e.gradient.bounds = control::Box<double, 4>{nominal * 0.2, nominal * 5.0};
  return e;
}

}  // namespace

RigSettings rough_board() {
  RigSettings s;
  host_sim::MuscleChannelSettings& muscle = s.board.channels[0];
  muscle.temperature_coefficient_per_K = coefficient_per_K;
  muscle.sense_filter_s = sense_filter_s;
  muscle.pwm_steps = 4095;
  muscle.position = {0.0, 0.060, 16, 10e-6};
  muscle.current = {-0.5, 30.0, 16, 0.002};
  s.board.supply = {0.0, 30.0, 14, 0.005};
  s.board.substeps = 5;

  BoardSettings& board = s.firmware;
  board.supply.scaling = {s.board.supply.per_count(), s.board.supply.low};
  ChannelSettings& channel = board.channels[0];
  channel.position.scaling = {muscle.position.per_count(), muscle.position.low};
  channel.heater.current.scaling = {muscle.current.per_count(), muscle.current.low};
  channel.heater.sense_filter_s = sense_filter_s;
  channel.heater.temperature_coefficient_per_K = coefficient_per_K;
  channel.supervision.max_travel_m = 0.025;
  // The simulated air is as the firmware believes: no slack for the interval.
  channel.thermal.coldest_ambient_C = channel.thermal.ambient_C;
  channel.controllers = {controller(control::ControllerKind::pi),
                         controller(control::ControllerKind::pd_ff),
                         controller(control::ControllerKind::mrac)};
  channel.estimators = {gradient()};
  return s;
}

Rig::Rig(const RigSettings& settings)
    : board(settings.board),
      loop(settings.firmware, board.devices()),
      executive(loop, board, settings.firmware.rate_Hz),
      ambient_C_(settings.firmware.channels[0].thermal.ambient_C) {}

void Rig::ask() {
  if (!commands_flow) return;
  const double t = time_s();
  switch (task) {
    case Task::position:
      send(Verb::position, scale * (0.010 + 0.004 * std::sin(0.8 * t)));
      break;
    case Task::power:
      send(Verb::power, scale * (1.8 + 0.7 * std::sin(0.8 * t)));
      break;
    case Task::identify:
    case Task::calibrate:
      if (state() == State::active) send(Verb::renew);
      break;
    case Task::nothing:
      break;
  }
}

void Rig::tick() {
  before_tick();
  if (state() == State::active) ask();
  executive.run_tick();
  if (telemetry_lives) loop.health().telemetry_beats.store(++beats_);
  Row row;
  while (loop.take(row)) {
  }
  Answer answer;
  while (loop.answer(answer)) {
    if (answer.refusal != Refusal::none) last_refusal = answer.refusal;
  }
  const double rise_K = muscle().plant().temperature_rise_K();
  const Snapshot& s = snapshot();
  interval_missed = interval_missed || ambient_C_ + rise_K > s.hottest_C + 1e-9 ||
                    ambient_C_ + rise_K < s.coldest_C - 1e-9;
  hottest_C = std::fmax(hottest_C, ambient_C_ + muscle().plant().peak_temperature_rise_K());
}

void Rig::run(double time_s) {
  const double end_s = this->time_s() + time_s;
  while (this->time_s() + 0.25e-3 < end_s)
    tick();
}

bool Rig::run_until(const std::function<bool()>& holds, double most_s) {
  const double end_s = time_s() + most_s;
  while (!holds()) {
    if (time_s() > end_s) return false;
    tick();
  }
  return true;
}

void Rig::boot() {
  run_until([&] { return loop.self_test().passed() || loop.self_test().failed(); }, 2.0);
  // Until then the muscle may be hot from before, and nothing is armed.
  run_until([&] { return snapshot().hottest_C < 120.0; }, 10.0);
  run(0.1);
}

void Rig::arm() {
  send(Verb::arm);
  tick();
}

void Rig::heat(Task new_task) {
  task = new_task;
  switch (task) {
    case Task::position:
      send(Verb::position, scale * 0.010);
      break;
    case Task::power:
      send(Verb::power, scale * 1.8);
      break;
    case Task::identify:
      send(Verb::identify);
      break;
    case Task::calibrate:
      send(Verb::calibrate);
      break;
    case Task::nothing:
      break;
  }
  tick();
}

}  // namespace supercoil::test
