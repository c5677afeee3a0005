#include "loop/channel.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "supercoil/control/actuator/conversions.hpp"

namespace supercoil {

namespace {

board::Resistance::Settings resistance_settings(const HeaterSettings& h) {
  return {h.sense_filter_s, h.resistance_filter_s, h.probe_duty, h.cold_resistance_Ohm};
}

/// Longer than every hold time at 1 kHz but the slowest; so many overruns are a fault by
/// themselves.
constexpr std::int64_t most_repeats = 1000;

/// Long against the sensor's noise, short against the muscle's motion.
constexpr double smoothing_s = 0.2;

/// 2³²/φ: steps of the golden ratio go round evenly also for who sees every n-th of them only, as
/// telemetry does; counting up, every fifth would show a fifth of the detectors.
constexpr std::uint32_t golden_turn = 2654435769U;

/// Infinity is an estimator's word for what it cannot tell.
double nan_if_infinite(double deviation) {
  return std::isfinite(deviation) ? deviation : std::nan("");
}

board::MeterComparison::Settings comparison_settings(const ChannelSettings& channel,
                                                     const BoardSettings& board) {
  return {board.supervision.lowest_supply_V, board.supervision.highest_supply_V,
          channel.supervision.resistance_part, board.supply.scaling.per_count,
          channel.heater.current.scaling.per_count};
}

/// Every time constant that the configured bounds allow.
control::CoolingFit::Settings cooling_settings(const ChannelSettings& channel) {
  const control::ThermalBounds b = board::with_weighed_mass(channel.thermal);
  return {b.lowest_mass_J_per_K / b.highest_transfer_W_per_K,
          b.highest_mass_J_per_K / b.lowest_transfer_W_per_K, channel.limiter.max_W};
}

std::size_t ticks_of(double time_s, double step_s) {
  return static_cast<std::size_t>(std::nearbyint(time_s / step_s));
}

}  // namespace

Channel::Channel(const ChannelSettings& settings, const BoardSettings& board,
                 const board::ChannelDevices& devices, std::uint8_t index)
    : settings_(settings),
      devices_(devices),
      step_s_(board.step_s()),
      ticks_per_s_(std::llround(board.rate_Hz)),
      index_(index),
      calibration_(settings.calibration),
      senses_(settings.senses),
      comparison_(comparison_settings(settings, board), board.step_s()),
      heat_facts_(settings.heat),
      steady_heat_(settings.thermal, board.step_s()),
      supervisor_(settings.supervision, settings.heater.cold_resistance_Ohm,
                  board.supervision.lowest_supply_V, board.step_s()),
      muscle_(settings.muscle),
      knows_muscle_(settings.knows_muscle),
      resistance_(resistance_settings(settings.heater), board.step_s()),
      power_bounds_(power_bounds(settings, board)),
      heat_(settings.thermal, settings.muscle, board.step_s()),
      probe_(settings.heater.probe_s, board.step_s()),
      proof_(proof_settings(settings, board), settings.muscle, settings.muscle_identified,
             board.rate_Hz),
      answer_ratio_(settings.answer_ratio),
      identify_({}, settings.muscle, settings.supervision.max_travel_m, board.step_s()),
      smooth_power_W_(smoothing_s, board.step_s()),
      smooth_error_m_(smoothing_s, board.step_s()),
      most_power_W_(settings.limiter.max_W),
      limiter_(settings.limiter, board.step_s()),
      power_stage_({devices.pwm->steps(), settings.heater.error_feedback}),
      delay_(ticks_of(settings.heater.delay_s, board.step_s())) {
  told_senses_.set(senses_);
  if (settings.thermal.weighed()) {
    cooling_fit_ =
        std::make_unique<control::CoolingFit>(cooling_settings(settings), board.step_s());
  }
  know_heat();
  for (const auto& controller : settings.controllers)
    controllers_.emplace_back(controller, step_s_).suit(control::theta_from(muscle_));
  for (const auto& estimator : settings.estimators)
    estimators_.emplace_back(estimator, step_s_);
  estimate_ = estimator().estimate();
}

void Channel::supervise(const BoardNow& board) {
  supply_V_ = board.supply_V * senses_.supply_gain;
  if (board.air != nullptr) heat_.follow_air(*board.air);
  observe_heat(board.periods);
  follow_probe(supply_V_);

  Evidence& e = evidence_;
  prove(board.periods);
  e.supply_V = supply_V_;
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
  e.hottest_C = heat_known_ ? heat_.hottest_C() : heat_.air().warmest_C();
  e.applied_W = acting_.power_W;
  e.resistance_fresh = resistance_.age_s() == 0.0 && !probe_.running();
  e.resistance_Ohm = resistance_.value_Ohm();
  const auto [least_Ohm, most_Ohm] = calibrated_Ohm();
  e.least_Ohm = least_Ohm;
  e.most_Ohm = most_Ohm;
  e.wanted_W = wanted_.wanted_power_W;
  e.limited = acting_.limited;
  present_fault_ = supervisor_.step(e);
  // Periods that were left out count as well: in them, nothing was renewed and nothing was heard.
  e.renewed = e.damaged_command = e.refused_command = e.obeyed_command = false;
  e.position_elapsed_s = 0.0;
  const std::int64_t more = std::min(board.periods, most_repeats);
  for (std::int64_t i = 1; i < more && present_fault_ == Fault::none; ++i)
    present_fault_ = supervisor_.step(e);
  if (!supervisor_.inside(e.sensor_m)) e.position.present = false;

  const Fault cause = board.fault != Fault::none ? board.fault : present_fault_;
  if (cause != Fault::none && !board.testing) {
    disarm(cause, board.fault != Fault::none ? board.margin : supervisor_.verdict().margin(cause));
  }
  if (!reset_asked_) state_.reset(false, true);
  // A probe whose value is judged to be no muscle's has made the channel safe by now.
  if (mode_ == Mode::calibrate && (e.probed || e.probe_failed)) {
    end_calibrate(e.probed ? e.resistance_Ohm : 0.0);
  }
}

void Channel::estimate() {
  if (!state_.may_heat() || !evidence_.position.present) return;
  estimator().step(evidence_.position.value, acting_.power_W);
  estimate_ = estimator().estimate();
  // Once a second: what the estimator knows of cooling, when it may be trusted.
  if (++ticks_ < ticks_per_s_) return;
  ticks_ = 0;
  learn_heat();
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
      input.range = {limiter_.min_W(),
                     std::fmin(limiter_.max_W(), supply_V_ * supply_V_ / resistance_.value_Ohm())};
      if (estimate_) controllers_[controller_].learn(*estimate_);
      wanted_ = controllers_[controller_].step(input);
      smooth_power_W_.step(acting_.power_W);
      smooth_error_m_.step(evidence_.position.value - wanted_.model_m);
      break;
    }
    case Mode::power:
      wanted_.wanted_power_W = reference_;
      smooth_power_W_.set(acting_.power_W);
      follow_comparison();
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

void Channel::limit() {
  limiter_.set_most(most_power_W());
  limiter_.set_unproven(proof_.max_W());
  if (state_.may_heat()) {
    allowed_ = limiter_.step(proof_.added_to(wanted_.wanted_power_W), heat_.hottest_C());
  } else {
    allowed_ = {};
  }
}

/// A reference that was shaped says why, where the limiter knows nothing better.
LimitedBy Channel::limited_by() const {
  using control::Infeasible;
  const bool at_an_end = allowed_.by <= LimitedBy::maximum;
  if (!at_an_end || wanted_.infeasible == Infeasible::nothing) return allowed_.by;
  return wanted_.infeasible == Infeasible::cooling ? LimitedBy::cooling : LimitedBy::maximum;
}

void Channel::drive() {
  const HeaterSettings& h = settings_.heater;
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
    out.applied_W = out.duty * supply_V_ * supply_V_ / resistance_.value_Ohm();
    out.clipped = true;
  }
  write_enable(state_.enable());
  write_duty(state_.enable() ? out.step : 0);
  const bool limited = allowed_.by != LimitedBy::nothing || out.clipped;
  // A dither that was cut is none.
  const double dither_W = state_.may_heat() && !limited ? proof_.dither_W() : 0.0;
  set_ = {out.applied_W, out.duty, limited, dither_W};
  acting_ = delay_.step(set_);
}

void Channel::disarm(Fault cause, const detectors::Margin& margin) {
  if (state_.state() != State::fault) {
    first_margin_ = margin;
    cause_is_new_ = cause != Fault::none;
  }
  state_.disarm(cause);
  probe_.stop();
  comparison_.forget();
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

void Channel::publish_estimate() {
  control::Estimate e{.theta = control::Theta::Constant(std::nan("")),
                      .relative_error_bound = std::nan("")};
  if (estimate_) e = *estimate_;
  Snapshot& s = snapshot_;
  s.theta = e.theta;
  s.error_bound = e.relative_error_bound;
  s.trusted = e.trusted;
  s.deviation = e.deviation.unaryExpr(&nan_if_infinite);
  s.bias_deviation_W = nan_if_infinite(e.bias_deviation_W);
  // Who cannot tell how far off a bias may be has none.
  const bool told = !std::isnan(s.bias_deviation_W);
  s.bias_W = told ? e.bias_W : s.bias_deviation_W;
  constexpr std::uint64_t asides = aside_names.size() - 1;
  s.aside = told ? static_cast<std::uint8_t>(1 + (turn_ * asides >> 32U)) : std::uint8_t{0};
}

const Snapshot& Channel::publish(const BoardNow& board, const Verdict& board_verdict) {
  Snapshot& s = snapshot_;
  s.time = board.time;
  s.channel = index_;
  s.state = state_.state();
  s.mode = mode_;
  s.fault = state_.first_cause();
  s.limited_by = limited_by();
  s.controller = static_cast<std::uint8_t>(controller_);
  s.probing = probe_.running();
  s.reference = reference_;
  s.model_m = wanted_.model_m;
  s.position_m = evidence_.position.present ? evidence_.position.value : std::nan("");
  s.wanted_W = wanted_.wanted_power_W;
  s.applied_W = acting_.power_W;
  s.limited = acting_.limited;
  s.proof_off = !settings_.supervision.proof_of_response;
  s.oscillated = wanted_.oscillated;
  s.duty = set_.duty;
  s.supply_V = supply_V_;
  s.current_A = evidence_.current.present ? evidence_.current.value : std::nan("");
  s.resistance_Ohm = resistance_.value_Ohm();
  s.resistance_age_s = resistance_.age_s();
  s.coldest_C = heat_.coldest_C();
  s.hottest_C = heat_.hottest_C();
  s.progress = mode_ == Mode::identify    ? identify_.progress()
               : mode_ == Mode::calibrate ? calibrate_.progress()
                                          : 0.0F;
  s.result = result_;
  const bool friction =
      answer_ratio_ > 0.0 && answer_ratio_ < detectors::Answer::least_answer_ratio;
  s.identify_notes = static_cast<std::uint8_t>(identify_.notes() | (friction ? note_friction : 0));
  const auto& faults = all_faults();
  turn_ += golden_turn;
  publish_estimate();
  s.turn = faults[(std::uint64_t{turn_} * faults.size()) >> 32U].fault;
  const Verdict& judge = board_verdict.judges(s.turn) ? board_verdict : supervisor_.verdict();
  s.margin = judge.margin(s.turn);
  // The first cause is told by the row that first shows the fault, whosever turn it is.
  if (std::exchange(cause_is_new_, false)) {
    s.turn = s.fault;
    s.margin = first_margin_;
  }
  s.gain = controllers_[controller_].gain(turn_);
  return s;
}

}  // namespace supercoil
