#include "runner/simulation.hpp"

#include <cstdint>
#include <random>
#include <utility>

#include "runner/board_of.hpp"
#include "runner/infeasible_time.hpp"

namespace supercoil::host_sim {

namespace {

/// Seconds that a slow muscle may have to cool, by the firmware's bounds, before it can be armed.
constexpr int max_waits = 3600;
/// Marks command()'s commands; the scenario's have no mark.
constexpr std::uint32_t commanded = 1;
/// Ticks between two looks into the recorder's ring, which holds 2 s.
constexpr std::uint32_t rows_every = 32;

/// The muscle that moves what the board commands. The believed one includes a joint's spring and a
/// bundle's other muscles.
const control::PhysicalParameters& true_muscle(const Conditions& c) {
  return c.joint || !c.companions.empty() ? c.muscle : c.plant.parameters;
}

}  // namespace

Simulation::Simulation(const Scenario& scenario)
    : scenario_(&scenario),
      conditions_(&scenario.start),
      ticks_(scenario.ticks()),
      step_s_(scenario.step_s()),
      board_(simulated_board_of(scenario)),
      loop_(firmware_of(scenario), board_.devices()),
      executive_(loop_, board_, scenario.rate_Hz) {
  set_air();
  boot();
}

void Simulation::boot() {
  const bool arms_now = arms(conditions_->action);
  boot_for(boot_s);
  const auto waits = [this] {
    return loop_.self_test().passed() && loop_.channel(0).state().state() == State::disarmed;
  };
  if (arms_now && waits()) {
    for (int i = 0; i < max_waits && waits(); ++i)
      boot_for(1.0);
    boot_for(boot_s);
  }
  inject_faults(conditions_->injected_faults);
  start_ = executive_.next_wake();
}

void Simulation::boot_for(double time_s) {
  const std::int64_t ticks = std::llround(time_s * scenario_->rate_Hz);
  for (std::int64_t i = 0; i < ticks; ++i) {
    // Requested at the first tick after the self-test.
    const bool ready = loop_.self_test().passed();
    const bool disarmed = loop_.channel(0).state().state() == State::disarmed;
    const bool arms_now = arms(conditions_->action);
    if (ready && disarmed && arms_now) send(Verb::arm);
    executive_.run_tick();
    housekeep();
  }
}

void Simulation::join_bus(std::function<void(const hal::CanFrame&)> listener) {
  bus_.emplace(board_, scenario_->can.bit_rate);
  bus_->listener = std::move(listener);
  link_.emplace(scenario_->can, firmware_of(*scenario_), loop_, *bus_,
                std::mt19937(static_cast<std::uint32_t>(scenario_->seed)));
}

/// What other threads do on a board.
void Simulation::housekeep() {
  loop_.health().telemetry_heartbeats.store(++beats_, std::memory_order_relaxed);
  if (link_ || beats_ % rows_every == 0) pass_rows();
  Answer answer;
  while (loop_.answer(answer)) {
    if (link_ && answer.command.source == Source::can) link_->answer(answer);
    if (answer.command.id == commanded) answer_ = answer;
  }
  if (link_) link_->poll(board_.now());
  for (std::size_t i = 0; i < static_cast<std::size_t>(scenario_->channels()); ++i) {
    while (loop_.channel(i).take_learned_update(learned_[i])) {
      if (on_learned_) on_learned_(i, learned_[i]);
    }
  }
}

void Simulation::pass_rows() {
  for (Row row; loop_.take(row);) {
    if (recorder_ != nullptr) recorder_->add(row);
    if (link_) link_->offer(row);
  }
  if (recorder_ != nullptr && beats_ % rows_every == 0) recorder_->poll(board_.true_time());
}

void Simulation::apply_event(const Event& event) {
  const Conditions& before = *conditions_;
  conditions_ = &event.conditions;
  if (demand_) demand_->change(*conditions_, true_muscle(*conditions_), conditions_->plant.load_N);
  MuscleChannel& muscle = board_.channel(0);
  const MuscleChannelSettings settings = muscle_channel_of(*scenario_, *conditions_);
  muscle.set(settings);
  muscle.position.set(settings.position);
  if (conditions_->joint) change_joint(before);
  if (!conditions_->companions.empty()) change_companions();
  board_.set_supply_V(conditions_->power.supply_V);
  set_air();
  inject_faults(conditions_->injected_faults);
  loop_.channel(0).set_power_range(conditions_->power.min_W, conditions_->power.max_W);
  if (event.new_controller) send(Verb::controller, static_cast<double>(++controllers_used_));
  if (event.new_estimator) send(Verb::estimator, static_cast<double>(++estimators_used_));
  resetting_ = resetting_ || event.reset;
  if (event.reset) send(Verb::reset);
}

void Simulation::change_joint(const Conditions& before) {
  const AntagonistConditions* antagonist = conditions_->antagonist();
  if (antagonist != nullptr) board_.channel(1).set(antagonist_channel_of(*scenario_, *conditions_));
  board_.joint(0).set(simulated_joint_of(*conditions_));
  if (antagonist == nullptr) return;
  // The user's own board has a range for each channel, which no event changes.
  if (!scenario_->board)
    loop_.channel(1).set_power_range(conditions_->power.min_W, conditions_->power.max_W);
  const double new_W = antagonist->co_contraction_W;
  if (new_W == before.antagonist()->co_contraction_W) return;
  // The operator commands it in watts of the antagonist.
  const double gain_ratio =
      firmware_of(*scenario_)
          .joints[0]
          .gain_ratio(loop_.channel(0).dc_gain_m_per_W(), loop_.channel(1).dc_gain_m_per_W());
  loop_.send({1, Verb::power, new_W / gain_ratio});
}

void Simulation::change_companions() {
  for (std::size_t i = 1; i < loop_.channels(); ++i) {
    board_.channel(i).set(companion_channel_of(*scenario_, *conditions_, i));
    if (!scenario_->board)
      loop_.channel(i).set_power_range(conditions_->power.min_W, conditions_->power.max_W);
  }
  board_.bundle(0).update();
}

double Simulation::peak_temperature_rise_K() const {
  double peak_K = 0.0;
  for (std::size_t i = 0; i < loop_.channels(); ++i)
    peak_K = std::fmax(peak_K, board_.channel(i).peak_temperature_rise_K());
  return peak_K;
}

void Simulation::set_air() {
  board_.set_air_C(conditions_->ambient.air_C + conditions_->ambient.sensor_offset_K);
}

void Simulation::inject_faults(const InjectedFaults& faults) {
  MuscleChannel& muscle = board_.channel(0);
  muscle.faults = {faults.heater_open,     faults.heater_short ? 0.5 : 0.0,
                   faults.switch_stuck_on, false,
                   faults.muscle_slack,    faults.switch_leak_ratio,
                   faults.agonist_torn,    faults.agonist_slack_m};
  if (conditions_->antagonist() != nullptr) {
    board_.channel(1).faults.wire_open = faults.antagonist_heater_open;
    board_.channel(1).faults.torn = faults.antagonist_torn;
    board_.channel(1).faults.slack_m = faults.antagonist_slack_m;
  }
  if (!conditions_->companions.empty()) {
    const auto broken = static_cast<std::size_t>(faults.open_heater_in_bundle);
    for (std::size_t i = 0; i < loop_.channels(); ++i)
      board_.channel(i).faults.wire_open = i + 1 == broken || (i == 0 && faults.heater_open);
  }
  muscle.position.set(
      ConverterFaults{faults.position_silent, faults.position_frozen, faults.position_loose});
  muscle.current.set(ConverterFaults{.gain = faults.current_gain});
  board_.supply.set(ConverterFaults{.gain = faults.supply_gain});
  muscle.pwm.refuses = faults.pwm_refuses ? hal::Status::io_error : hal::Status::ok;
  board_.stop_circuit.level.high = !faults.stop_pressed;
}

void Simulation::send(Verb verb, double value) {
  loop_.send({0, verb, value});
}

double Simulation::reference_at(double time_s) {
  if (conditions_->action != OperatorAction::first_motion) return conditions_->reference.at(time_s);
  if (last_action_ != OperatorAction::first_motion) {
    if (loop_.channel(0).state().state() != State::armed) return NAN;
    first_motion_.emplace(loop_, firmware_of(*scenario_), controllers_used_, time_s);
  }
  return first_motion_->reference_m(time_s);
}

/// Before a first motion, where a mode is renewed until it ends by itself, and after it.
void Simulation::command_rest() {
  const bool mode =
      last_action_ == OperatorAction::identify || last_action_ == OperatorAction::calibrate;
  if (loop_.channel(0).state().state() == State::active) send(mode ? Verb::renew : Verb::rest);
}

/// As a master does: renews the command every tick.
void Simulation::renew_command(double reference) {
  if (conditions_->injected_faults.commands_stop || conditions_->action == OperatorAction::none)
    return;
  const State state = loop_.channel(0).state().state();
  if (resetting_ && state == State::disarmed) send(Verb::arm);
  if (state == State::armed) resetting_ = false;
  if (state != State::armed && state != State::active) return;
  switch (conditions_->action) {
    case OperatorAction::track:
      send(conditions_->controller.kind == control::ControllerKind::power ? Verb::power
                                                                          : Verb::position,
           reference);
      break;
    case OperatorAction::identify:
    case OperatorAction::calibrate: {
      // Only once: the mode ends by itself and is not requested again.
      const bool requested = last_action_ == conditions_->action;
      const Verb verb =
          conditions_->action == OperatorAction::identify ? Verb::identify : Verb::calibrate;
      if (!requested) send(Verb::rest);
      if (!requested) send(verb);
      if (requested && state == State::active) send(Verb::renew);
      break;
    }
    case OperatorAction::first_motion:
      if (std::isnan(reference)) return command_rest();
      send(Verb::position, reference);
      break;
    case OperatorAction::rest:
      if (state == State::active) send(Verb::rest);
      break;
    case OperatorAction::disarm:
      send(Verb::disarm);
      break;
    case OperatorAction::none:
      break;
  }
  last_action_ = conditions_->action;
}

Answer Simulation::command(Verb verb, double value, std::uint8_t channel) {
  loop_.send({channel, verb, value, Source::local, commanded});
  step();
  return answer_;
}

const TickRecord& Simulation::step() {
  const double time_s = static_cast<double>(tick_) * step_s_;
  board_.advance_to(executive_.next_wake());
  while (next_event_ < scenario_->events.size() && scenario_->events[next_event_].at_s <= time_s) {
    apply_event(scenario_->events[next_event_++]);
  }
  const double reference = reference_at(time_s);
  renew_command(reference);
  executive_.run_tick();
  housekeep();
  if (first_motion_) first_motion_->update(time_s, loop_.channel(0).snapshot());
  ++tick_;
  record(time_s, reference);
  return record_;
}

LimitedBy Simulation::reference_limited_by() {
  const Snapshot& s = loop_.channel(0).snapshot();
  const Conditions& c = *conditions_;
  if (s.mode != Mode::position) {
    demand_.reset();
    return LimitedBy::nothing;
  }
  // For two muscles that pull against each other, only their limits tell what they can do.
  if (c.antagonist() != nullptr)
    return is_infeasible(s.limited_by) ? s.limited_by : loop_.channel(1).snapshot().limited_by;
  if (!demand_) {
    const AvailablePower available(firmware_of(*scenario_), c.power.supply_V, step_s_);
    // Noise shifts the start of a model by this much; a shaped model moves along its limit.
    const double tolerated_ratio = c.controller.shape_reference ? 1e-9 : 0.02;
    demand_.emplace(c, true_muscle(c), c.plant.load_N, available, step_s_, tolerated_ratio);
    demand_->start_at(s.model_m);
  }
  const LimitedBy by = demand_->step(s.reference).by;
  if (by != LimitedBy::nothing) return by;
  // The board knows the heat better, and which power it could prove.
  return is_thermal(s.limited_by) ? s.limited_by : LimitedBy::nothing;
}

void Simulation::record(double time_s, double reference) {
  const Snapshot& s = loop_.channel(0).snapshot();
  const double ambient_C = conditions_->ambient.air_C;
  TickRecord& r = record_;
  r.time_s = time_s;
  r.reference = reference;
  r.model_m = s.model_m;
  r.position_m = board_.channel(0).position_m();
  r.measured_m = s.position_m;
  r.power_W = s.demanded_W;
  r.applied_power_W = s.applied_W;
  r.temperature_rise_K = rise_K(0);
  r.thermometer_C = board_.channel(0).thermometer_C();
  r.coldest_K = s.coldest_C - ambient_C;
  r.hottest_K = s.hottest_C - ambient_C;
  r.limited = s.limited;
  r.oscillation_period_s = s.oscillation_period_s;
  r.open_loop = s.mode != Mode::position;
  r.commands_power = conditions_->controller.kind == control::ControllerKind::power;
  r.state = s.state;
  r.fault = s.fault;
  const bool has_margin = s.fault != Fault::none && s.margin_selector == s.fault && s.margin.judged;
  r.fault_margin = has_margin ? s.margin : detectors::Margin{.measured = NAN, .limit = NAN};
  r.board_fault = loop_.board_fault();
  r.limited_by = s.limited_by;
  r.reference_limited_by = reference_limited_by();
  r.clipped_power_W =
      control::PowerRange{conditions_->power.min_W, conditions_->power.max_W}.clip(s.demanded_W);
  if (conditions_->antagonist() != nullptr) r.antagonist = antagonist_record();
  if (!conditions_->companions.empty()) r.bundle = bundle_record(r);
}

AntagonistRecord Simulation::antagonist_record() const {
  const Snapshot& s = loop_.channel(1).snapshot();
  const double ambient_C = conditions_->ambient.air_C;
  return {s.applied_W, rise_K(1), s.coldest_C - ambient_C, s.hottest_C - ambient_C, s.limited_by};
}

BundleRecord Simulation::bundle_record(const TickRecord& first) const {
  const double ambient_C = conditions_->ambient.air_C;
  BundleRecord r{first.temperature_rise_K, first.temperature_rise_K, first.hottest_K};
  for (std::size_t i = 1; i < loop_.channels(); ++i) {
    const Snapshot& s = loop_.channel(i).snapshot();
    const double rise = rise_K(i);
    r.min_temperature_rise_K = std::fmin(r.min_temperature_rise_K, rise);
    r.max_temperature_rise_K = std::fmax(r.max_temperature_rise_K, rise);
    r.hottest_K = std::fmax(r.hottest_K, s.hottest_C - ambient_C);
    r.outside = r.outside || is_outside(rise, s.coldest_C - ambient_C, s.hottest_C - ambient_C);
  }
  return r;
}

/// Rise of the channel's muscle above the present air.
double Simulation::rise_K(std::size_t channel) const {
  const MuscleChannel& muscle = board_.channel(channel);
  return muscle.temperature_rise_K() + (muscle.rise_from_C() - conditions_->ambient.air_C);
}

}  // namespace supercoil::host_sim
