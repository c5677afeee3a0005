#include "loop/channel.hpp"

#include <algorithm>
#include <cmath>

namespace supercoil {

namespace {

board::Resistance::Settings resistance_settings(const HeaterSettings& h) {
  return {h.sense_filter_s, h.resistance_filter_s, h.probe_duty, h.cold_resistance_Ohm};
}

/// A resistance of so many times the cold one is a broken wire and the sense's own offset.
constexpr double as_good_as_open = 4.0;

/// Longer than every hold time at 1 kHz but the slowest; so many overruns are a fault by
/// themselves.
constexpr long most_repeats = 1000;

/// Long against the sensor's noise, short against the muscle's motion.
constexpr double smoothing_s = 0.2;

std::size_t ticks_of(double time_s, double step_s) {
  return static_cast<std::size_t>(std::nearbyint(time_s / step_s));
}

}  // namespace

Channel::Channel(const ChannelSettings& settings, const BoardSettings& board,
                 const board::ChannelDevices& devices, std::uint8_t index)
    : settings_(settings),
      devices_(devices),
      step_s_(board.step_s()),
      index_(index),
      calibration_(settings.calibration),
      supervisor_(settings.supervision, settings.heater.cold_resistance_Ohm,
                  board.supervision.lowest_supply_V, board.step_s()),
      muscle_(settings.muscle),
      resistance_(resistance_settings(settings.heater), board.step_s()),
      heat_(settings.thermal, settings.muscle, board.step_s()),
      probe_(settings.heater.probe_s, board.step_s()),
      identify_({}, settings.muscle, board.step_s()),
      smooth_power_W_(smoothing_s, board.step_s()),
      smooth_error_m_(smoothing_s, board.step_s()),
      limiter_(settings.limiter, board.step_s()),
      power_stage_({devices.pwm->steps(), settings.heater.error_feedback}),
      delay_(ticks_of(settings.heater.delay_s, board.step_s())) {
  for (const auto& controller : settings.controllers)
    controllers_.emplace_back(controller, step_s_);
  for (const auto& estimator : settings.estimators)
    estimators_.emplace_back(estimator, step_s_);
}

void Channel::sample(hal::Time now) {
  evidence_.renewed = evidence_.obeyed_command = evidence_.refused_command = false;
  reset_asked_ = false;
  sample_position(now);
  const InputSettings& input = settings_.heater.current;
  board::measure(devices_.current->latest(), input.scaling, now, input.max_age_s,
                 evidence_.current);
}

void Channel::sample_position(hal::Time now) {
  const hal::Sample sample = devices_.position->latest();
  const InputSettings& input = settings_.position;
  board::Measured& position = evidence_.position;
  board::measure(sample, input.scaling, now, input.max_age_s, position);
  evidence_.sensor_m = position.value;
  position.value = (position.value - calibration_.position_offset_m) * calibration_.position_scale;
  const bool fresh = position.present && sample.taken != position_taken_;
  evidence_.position_elapsed_s = fresh ? hal::seconds(sample.taken - position_taken_) : 0.0;
  if (fresh) position_taken_ = sample.taken;
}

void Channel::supervise(const BoardNow& board) {
  supply_V_ = board.supply_V;
  observe_heat(board.supply_V, board.periods);
  follow_probe(board.supply_V);

  Evidence& e = evidence_;
  e.supply_V = board.supply_V;
  e.hot = heat_.hottest_K() > hot_K;
  e.heating = state_.may_heat();
  e.off = acting_.duty == 0.0 || !state_.enable();
  e.duty = resistance_.duty();
  e.set_step = written_step_;
  e.read_back = devices_.pwm->read_back();
  e.devices_ok = writes_ok_;
  e.expected_m = heat_.expected_m();
  // How hot it was before boot is not known: nothing is armed before it must have cooled.
  heat_known_ = heat_known_ || heat_.hottest_C() < settings_.limiter.derate_from_C;
  e.hottest_C = heat_known_ ? heat_.hottest_C() : settings_.thermal.ambient_C;
  e.applied_W = acting_.power_W;
  const double cold_Ohm = calibration_.cold_resistance_Ohm;
  e.resistance_fresh = resistance_.age_s() == 0.0 && !probe_.running();
  e.resistance_Ohm = resistance_.value_Ohm();
  e.least_Ohm = cold_Ohm;
  e.most_Ohm =
      cold_Ohm * (1.0 + settings_.heater.temperature_coefficient_per_K * heat_.hottest_K());
  e.wanted_W = wanted_.wanted_power_W;
  e.limited = acting_.limited;
  present_fault_ = supervisor_.step(e);
  // Periods that were left out count as well: in them, nothing was renewed and nothing was heard.
  e.renewed = e.damaged_command = e.refused_command = e.obeyed_command = false;
  e.position_elapsed_s = 0.0;
  const long more = std::min(board.periods, most_repeats);
  for (long i = 1; i < more && present_fault_ == Fault::none; ++i)
    present_fault_ = supervisor_.step(e);
  if (!supervisor_.inside(e.sensor_m)) e.position.present = false;

  const Fault cause = board.fault != Fault::none ? board.fault : present_fault_;
  if (cause != Fault::none && !board.testing) {
    disarm(cause, board.fault != Fault::none ? board.margin : supervisor_.verdict().margin(cause));
  }
  if (!reset_asked_) state_.reset(false, true);
}

/// The muscle's temperature, from the power that acted and the power that was measured: if a switch
/// conducts by itself, only the current knows.
void Channel::observe_heat(double supply_V, long periods) {
  const bool measures = evidence_.current.present && supply_V > 0.0;
  if (measures) resistance_.step(acting_.duty, supply_V, evidence_.current.value);
  const double told_W = acting_.power_W;
  const double noise_A = settings_.supervision.current_noise_A;
  const double measured_W = measures ? supply_V * evidence_.current.value : limiter_.max_W();
  // A measured power takes part only where it differs by more than the sense's own error.
  const double tolerance_W = supply_V * noise_A + 0.05 * told_W;
  const bool differs = std::abs(measured_W - told_W) > tolerance_W;
  // The cold end may as well be too cold: nothing is protected by it.
  const double least_W = std::fmin(told_W, measured_W) - supply_V * noise_A;
  const double most_W = differs ? std::fmax(told_W, measured_W) : told_W;
  heat_.step(std::fmax(least_W, 0.0), most_W, told_W);
  // In periods that were left out the power may have gone on, or the charge pump have cut it.
  for (long i = 1; i < periods; ++i)
    heat_.step(0.0, most_W, told_W);
  evidence_.most_W = most_W;

  const HeaterSettings& h = settings_.heater;
  evidence_.tells_temperature = h.temperature_coefficient_per_K > 0.0 && resistance_.age_s() < 1.0;
  evidence_.from_resistance_K =
      evidence_.tells_temperature
          ? (resistance_.value_Ohm() / calibration_.cold_resistance_Ohm - 1.0) /
                h.temperature_coefficient_per_K
          : 0.0;
  evidence_.from_position_K = evidence_.position.value / heat_.metres_per_K();
}

void Channel::follow_probe(double supply_V) {
  evidence_.probed_Ohm = 0.0;
  evidence_.probe_failed = false;
  const auto probed = probe_.step(resistance_.duty(), supply_V,
                                  evidence_.current.present ? evidence_.current.value : 0.0);
  if (!probed.ended) return;
  const double most_Ohm = as_good_as_open * calibration_.cold_resistance_Ohm;
  evidence_.probe_failed = !(probed.resistance_Ohm > 0.0 && probed.resistance_Ohm < most_Ohm);
  evidence_.probed_Ohm = evidence_.probe_failed ? 0.0 : probed.resistance_Ohm;
  // What it should be: the calibrated one at whichever temperature of the interval suits it best.
  const double per_K = settings_.heater.temperature_coefficient_per_K;
  const double cold_Ohm = calibration_.cold_resistance_Ohm;
  evidence_.calibrated_Ohm =
      std::clamp(probed.resistance_Ohm, cold_Ohm * (1.0 + per_K * heat_.coldest_K()),
                 cold_Ohm * (1.0 + per_K * heat_.hottest_K()));
  if (!evidence_.probe_failed) resistance_.set(probed.resistance_Ohm);
  if (mode_ == Mode::calibrate) {
    if (calibrate_.probed(evidence_.probed_Ohm) == modes::Calibrate::Outcome::found) {
      storage::Calibration found = calibration_;
      found.position_offset_m += calibrate_.zero_m() / calibration_.position_scale;
      found.cold_resistance_Ohm = calibrate_.cold_resistance_Ohm();
      keep(muscle_, found);
    }
    state_.rest();
    rest();
  }
}

void Channel::estimate() {
  if (!state_.may_heat() || !evidence_.position.present) return;
  estimator().step(evidence_.position.value, acting_.power_W);
  if (++ticks_ % static_cast<long>(1.0 / step_s_) == 0) learn_heat();
}

/// Once a second: what the estimator knows of cooling, when it may be trusted.
void Channel::learn_heat() {
  const auto estimate = estimator().estimate();
  if (!estimate || !estimate->trusted) return;
  const control::PhysicalParameters& m = settings_.muscle;
  const auto physical =
      control::physical_from(estimate->theta, {m.force_per_kelvin_N_per_K, m.moving_mass_kg});
  if (physical) heat_.learn(physical->thermal_pole_rad_per_s());
}

void Channel::control() {
  wanted_ = {};
  if (!state_.may_heat() || !evidence_.position.present) return;
  switch (mode_) {
    case Mode::position: {
      control::ControllerInput input;
      input.reference_m = reference_;
      input.position_m = evidence_.position.value;
      input.applied_power_W = acting_.power_W;
      input.limited = acting_.limited;
      wanted_ = controllers_[controller_].step(input);
      smooth_power_W_.step(acting_.power_W);
      smooth_error_m_.step(evidence_.position.value - wanted_.model_m);
      break;
    }
    case Mode::power:
      wanted_.wanted_power_W = reference_;
      smooth_power_W_.set(acting_.power_W);
      break;
    case Mode::identify:
      step_identify();
      break;
    case Mode::calibrate:
      step_calibrate();
      break;
    case Mode::rest:
      break;
  }
}

void Channel::step_identify() {
  wanted_.wanted_power_W = identify_.power_W(limiter_.max_W());
  const auto outcome = identify_.step(evidence_.position.value, acting_.power_W);
  if (outcome == modes::Identify::Outcome::running) return;
  if (outcome == modes::Identify::Outcome::found) keep(identify_.found(), calibration_);
  wanted_ = {};
  state_.rest();
  rest();
}

void Channel::step_calibrate() {
  if (probe_.running()) return;
  switch (calibrate_.step(heat_.hottest_K(), evidence_.position.value, step_s_)) {
    case modes::Calibrate::Outcome::probe:
      probe_.start();
      break;
    case modes::Calibrate::Outcome::failed:
      state_.rest();
      rest();
      break;
    case modes::Calibrate::Outcome::running:
    case modes::Calibrate::Outcome::found:
      break;
  }
}

void Channel::limit() {
  if (state_.may_heat()) {
    allowed_ = limiter_.step(wanted_.wanted_power_W, heat_.hottest_C());
  } else {
    allowed_ = {};
  }
}

void Channel::drive() {
  const HeaterSettings& h = settings_.heater;
  const double full_W = supply_V_ * supply_V_ / resistance_.value_Ohm();
  board::PowerStage::Output out;
  if (state_.may_heat()) {
    // Calibration probes when it has found the zero, and not before.
    const bool old = resistance_.age_s() > h.probe_every_s && mode_ != Mode::calibrate;
    if (old && !probe_.running()) probe_.start();
    out = power_stage_.step(allowed_.power_W, resistance_.value_Ohm(), supply_V_, limiter_.max_W());
  }
  if (state_.enable() && probe_.running() && out.duty < h.probe_duty) {
    out.step = static_cast<int>(h.probe_duty * devices_.pwm->steps());
    out.duty = static_cast<double>(out.step) / devices_.pwm->steps();
    out.applied_W = out.duty * full_W;
    out.clipped = true;
  }
  write_enable(state_.enable());
  write_duty(state_.enable() ? out.step : 0);
  set_ = {out.applied_W, out.duty, allowed_.by != LimitedBy::nothing || out.clipped};
  acting_ = delay_.step(set_);
}

void Channel::disarm(Fault cause, const detectors::Margin& margin) {
  if (state_.state() != State::fault) first_margin_ = margin;
  state_.disarm(cause);
  probe_.stop();
  rest();
  write_duty(0);
  write_enable(false);
}

void Channel::test_drive(double duty, bool enable) {
  write_enable(enable);
  write_duty(static_cast<int>(duty * devices_.pwm->steps()));
  // Of a board that is well, none of it reaches the muscle.
  acting_ = delay_.step({});
}

void Channel::write_duty(int step) {
  if (step == written_step_ && writes_ok_) return;
  writes_ok_ = devices_.pwm->set(step) == hal::Status::ok;
  written_step_ = step;
}

void Channel::write_enable(bool high) {
  if (static_cast<int>(high) == written_enable_ && lines_ok_) return;
  lines_ok_ = devices_.enable->set(high) == hal::Status::ok;
  written_enable_ = static_cast<int>(high);
}

const Snapshot& Channel::publish(const BoardNow& board, const Verdict& board_verdict) {
  Snapshot& s = snapshot_;
  s.time = board.time;
  s.channel = index_;
  s.state = state_.state();
  s.mode = mode_;
  s.fault = state_.first_cause();
  s.limited_by = allowed_.by;
  s.controller = static_cast<std::uint8_t>(controller_);
  s.probing = probe_.running();
  s.reference = reference_;
  s.model_m = wanted_.model_m;
  s.position_m = evidence_.position.present ? evidence_.position.value : std::nan("");
  s.wanted_W = wanted_.wanted_power_W;
  s.applied_W = acting_.power_W;
  s.limited = acting_.limited;
  s.duty = set_.duty;
  s.supply_V = supply_V_;
  s.current_A = evidence_.current.present ? evidence_.current.value : std::nan("");
  s.resistance_Ohm = resistance_.value_Ohm();
  s.resistance_age_s = resistance_.age_s();
  s.coldest_C = heat_.coldest_C();
  s.hottest_C = heat_.hottest_C();
  if (const auto estimate = estimator().estimate()) {
    s.theta = estimate->theta;
    s.error_bound = estimate->relative_error_bound;
    s.trusted = estimate->trusted;
  }
  s.progress = mode_ == Mode::identify    ? identify_.progress()
               : mode_ == Mode::calibrate ? calibrate_.progress()
                                          : 0.0F;
  const auto& faults = all_faults();
  turn_ = (turn_ + 1) % faults.size();
  s.turn = faults[turn_].fault;
  const Verdict& judge = board_verdict.judges(s.turn) ? board_verdict : supervisor_.verdict();
  s.margin = judge.margin(s.turn);
  return s;
}

}  // namespace supercoil
