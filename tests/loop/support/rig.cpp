#include "loop/support/rig.hpp"

#include <algorithm>

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

/// One muscle with its sensors, and what the firmware knows of it.
void add_channel(RigSettings& s) {
  host_sim::MuscleChannelSettings muscle;
  muscle.temperature_coefficient_per_K = coefficient_per_K;
  muscle.sense_filter_s = sense_filter_s;
  muscle.pwm_steps = 4095;
  muscle.position = {0.0, 0.060, 16, 10e-6};
  muscle.current = {-0.5, 30.0, 16, 0.002};
  s.board.channels.push_back(muscle);

  ChannelSettings channel;
  channel.position.scaling = {muscle.position.per_count(), muscle.position.low};
  channel.heater.current.scaling = {muscle.current.per_count(), muscle.current.low};
  channel.heater.sense_filter_s = sense_filter_s;
  channel.heater.temperature_coefficient_per_K = coefficient_per_K;
  channel.supervision.max_travel_m = 0.025;
  // The simulated air is as the firmware believes: no slack for the interval.
  channel.thermal.air.coldest_C = channel.thermal.air.warmest_C;
  channel.controllers = {controller(control::ControllerKind::pi),
                         controller(control::ControllerKind::pd_ff),
                         controller(control::ControllerKind::mrac)};
  channel.estimators = {gradient()};
  s.firmware.channels.push_back(channel);
}

}  // namespace

RigSettings rough_board(double rate_Hz) {
  RigSettings s;
  s.board.rate_Hz = rate_Hz;
  // At high rates a period is short compared with everything on the board.
  s.board.substeps = rate_Hz > 5e3 ? 1 : 5;
  s.board.supply = {0.0, 30.0, 14, 0.005};
  s.board.channels.clear();

  BoardSettings& board = s.firmware;
  board.rate_Hz = rate_Hz;
  board.supply.scaling = {s.board.supply.per_count(), s.board.supply.low};
  board.supervision.late_s = 0.5 * board.step_s();
  // The pump must outlive twice the overruns that are tolerated.
  const double borne_s = board.supervision.overruns_in_a_row * board.step_s();
  board.supervision.charge_pump_decay_s =
      std::max(board.supervision.charge_pump_decay_s, 2.4 * borne_s);
  s.board.charge_pump_decay_s = board.supervision.charge_pump_decay_s;
  board.channels.clear();
  for (int i = 0; i < 2; ++i)
    add_channel(s);
  return s;
}

RigSettings joint_board(double rate_Hz) {
  constexpr double lever_m = 0.015;
  constexpr double travel_m = 0.008;
  RigSettings s = rough_board(rate_Hz);
  host_sim::JointPlantSettings joint;
  joint.lever = control::Lever(lever_m);
  s.board.joints = {{0, 1, joint, 0.0}};
  add_joint(s.firmware, {0, 1, joint.lever, 0.8});
  const host_sim::ConverterSettings sensor{-0.012, 0.012, 16, 5e-6};
  for (std::size_t i = 0; i < s.firmware.channels.size(); ++i) {
    const double way = i == 0 ? 1.0 : -1.0;
    control::PhysicalParameters& plant = s.board.channels[i].plant;
    plant.heat_transfer_W_per_K *= 1.0 + 0.1 * way;
    plant.force_per_kelvin_N_per_K *= 1.0 - 0.1 * way;
    s.board.channels[i].position = sensor;

    ChannelSettings& channel = s.firmware.channels[i];
    channel.muscle.stiffness_N_per_m *= 2.0;
    channel.muscle.damping_Ns_per_m *= 2.0;
    channel.muscle.moving_mass_kg = joint.inertia_kg_m2 / (lever_m * lever_m);
    channel.position.scaling = {way * sensor.per_count(), way * sensor.low};
    channel.supervision.min_position_m = -0.0119;
    channel.supervision.max_position_m = 0.0119;
    channel.supervision.max_travel_m = travel_m;
    channel.supervision.position_noise_rms_m = sensor.noise_rms;
    channel.controllers = {controller(control::ControllerKind::learned_ff),
                           controller(control::ControllerKind::pi)};
    for (control::ControllerSettings& c : channel.controllers) {
      c.dc_gain_m_per_W = channel.muscle.dc_gain_m_per_W();
      c.set_nominal(channel.muscle, channel.limiter.max_W);
    }
  }
  return s;
}

Rig::Rig(const RigSettings& settings)
    : board(settings.board),
      loop(settings.firmware, board.devices()),
      executive(loop, board, settings.firmware.rate_Hz),
      period_s_(settings.firmware.step_s()),
      ambient_C_(settings.firmware.channels[tested].thermal.air.warmest_C) {}

void Rig::send_task_command() {
  if (!commands_flow) return;
  // Scaled commands are constant: they do not wait for the wave's crest.
  const double wave = scale == 1.0 ? std::sin(0.8 * time_s()) : 1.0;
  switch (task) {
    case Task::position:
      send(Verb::position, scale * (0.010 + 0.004 * wave));
      break;
    case Task::power:
      send(Verb::power, scale * (1.8 + 0.7 * wave));
      break;
    case Task::identify:
    case Task::calibrate:
      if (state() == State::active) send(Verb::renew);
      break;
    case Task::nothing:
      break;
  }
}

void Rig::send_neighbour_command() {
  if (!neighbour_follows_ || loop.channel(neighbour).state().state() != State::active) return;
  loop.send({neighbour, Verb::position, 0.008 + 0.003 * std::sin(0.6 * time_s())});
}

void Rig::tick() {
  before_tick();
  if (state() == State::active) send_task_command();
  send_neighbour_command();
  executive.run_tick();
  if (telemetry_lives) loop.health().telemetry_heartbeats.store(++beats_);
  Row row;
  while (loop.take(row)) {
  }
  Answer answer;
  while (loop.answer(answer)) {
    if (answer.command.channel < last_answers.size())
      last_answers[answer.command.channel] = answer.refusal;
    if (answer.command.channel == neighbour) continue;
    if (answer.refusal != Refusal::none) {
      last_refusal = answer.refusal;
      last_nearest = answer.nearest;
    }
    if (answer.command.verb == Verb::reset) answer_to_reset = answer.refusal;
  }
  watch_heat();
}

void Rig::watch_heat() {
  for (std::size_t i = 0; i < loop.channels(); ++i) {
    const double true_C = ambient_C_ + board.channel(i).temperature_rise_K();
    const Snapshot& s = loop.channel(i).snapshot();
    interval_missed = interval_missed || true_C > s.hottest_C + 1e-9 || true_C < s.coldest_C - 1e-9;
  }
}

void Rig::run(double time_s) {
  const double end_s = this->time_s() + time_s;
  while (this->time_s() + 0.25 * period_s_ < end_s)
    tick();
}

void Rig::run_ticks(int ticks) {
  for (int i = 0; i < ticks; ++i)
    tick();
}

bool Rig::run_until(const std::function<bool()>& holds, double max_s) {
  const double end_s = time_s() + max_s;
  while (!holds()) {
    if (time_s() + 0.25 * period_s_ > end_s) return false;
    tick();
  }
  return true;
}

Refusal Rig::answer_to(Verb verb, double value) {
  last_refusal = Refusal::none;
  send(verb, value);
  tick();
  return last_refusal;
}

Refusal Rig::answer_of(std::uint8_t channel, Verb verb, double value) {
  loop.send({channel, verb, value});
  tick();
  return last_answers.at(channel);
}

void Rig::hold_power(double power_W, double time_s) {
  for (double end_s = this->time_s() + time_s; this->time_s() < end_s;) {
    send(Verb::power, power_W);
    run(0.05);
  }
}

void Rig::boot() {
  run_until([&] { return loop.self_test().passed() || loop.self_test().failed(); }, 2.0);
  // Until it must have cooled the muscle may be hot from before, and nothing is armed.
  const auto cool = [&](std::uint8_t i) { return loop.channel(i).snapshot().hottest_C < 120.0; };
  run_until([&] { return cool(tested) && cool(neighbour); }, 10.0);
  run(0.1);
}

void Rig::arm() {
  send(Verb::arm);
  tick();
}

void Rig::start_neighbour() {
  neighbour_follows_ = true;
  loop.send({neighbour, Verb::arm, 0.0});
  run(0.2);
  loop.send({neighbour, Verb::position, 0.008});
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
