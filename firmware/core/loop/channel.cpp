#include "loop/channel.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "supercoil/control/actuator/conversions.hpp"

namespace supercoil {

namespace {

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

}  // namespace

Channel::Channel(const ChannelSettings& settings, const BoardSettings& board,
                 const board::ChannelDevices& devices, std::uint8_t index)
    : settings_(settings),
      sensor_(devices.position),
      step_s_(board.step_s()),
      ticks_per_s_(std::llround(board.rate_Hz)),
      index_(index),
      heater_(settings, board, devices),
      calibration_(settings.calibration),
      comparison_(comparison_settings(settings, board), board.step_s()),
      steady_heat_(settings.thermal, board.step_s()),
      supervisor_(settings.supervision, settings.heater.cold_resistance_Ohm,
                  board.supervision.lowest_supply_V, board.step_s()),
      muscle_(settings.muscle),
      knows_muscle_(settings.knows_muscle),
      proof_(proof_settings(settings, board), settings.muscle, settings.muscle_identified,
             board.rate_Hz),
      answer_ratio_(settings.answer_ratio),
      identify_({}, settings.muscle, settings.supervision.max_travel_m, board.step_s()),
      smooth_power_W_(smoothing_s, board.step_s()),
      smooth_error_m_(smoothing_s, board.step_s()) {
  if (settings.thermal.weighed()) {
    cooling_fit_ =
        std::make_unique<control::CoolingFit>(cooling_settings(settings), board.step_s());
  }
  for (const auto& controller : settings.controllers)
    controllers_.emplace_back(controller, step_s_).suit(control::theta_from(muscle_));
  for (const auto& estimator : settings.estimators)
    estimators_.emplace_back(estimator, step_s_);
  estimate_ = estimator().estimate();
}

void Channel::supervise(const BoardNow& board) {
  heater_.observe(board.supply_V, board.air, board.periods);
  prove(board.periods);
  Evidence& e = evidence_;
  heater_.tell(state_, e);
  e.heating = state_.may_heat();
  e.from_position_K =
      heater_.tells_temperature() ? e.position.value / heater_.heat().metres_per_K() : 0.0;
  e.wanted_W = wanted_.wanted_power_W;
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
  estimator().step(evidence_.position.value, heater_.acting().power_W);
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
      input.applied_power_W = heater_.acting().power_W;
      input.limited = heater_.acting().limited;
      input.range = heater_.power_range();
      if (estimate_) controllers_[controller_].learn(*estimate_);
      wanted_ = controllers_[controller_].step(input);
      smooth_power_W_.step(heater_.acting().power_W);
      smooth_error_m_.step(evidence_.position.value - wanted_.model_m);
      break;
    }
    case Mode::power:
      wanted_.wanted_power_W = reference_;
      smooth_power_W_.set(heater_.acting().power_W);
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
  heater_.limit(state_, proof_.added_to(wanted_.wanted_power_W), proof_.max_W());
}

/// A reference that was shaped says why, where the limiter knows nothing better.
LimitedBy Channel::limited_by() const {
  using control::Infeasible;
  const LimitedBy by = heater_.allowed().by;
  const bool at_an_end = by <= LimitedBy::maximum;
  if (!at_an_end || wanted_.infeasible == Infeasible::nothing) return by;
  return wanted_.infeasible == Infeasible::cooling ? LimitedBy::cooling : LimitedBy::maximum;
}

void Channel::drive() {
  // Calibration probes when it has found the zero, and not before.
  heater_.drive(state_, mode_ != Mode::calibrate, proof_.dither_W());
}

void Channel::disarm(Fault cause, const detectors::Margin& margin) {
  if (state_.state() != State::fault) {
    first_margin_ = margin;
    cause_is_new_ = cause != Fault::none;
  }
  state_.disarm(cause);
  comparison_.forget();
  rest();
  heater_.cut();
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
  s.probing = heater_.probing();
  s.reference = reference_;
  s.model_m = wanted_.model_m;
  s.position_m = evidence_.position.present ? evidence_.position.value : std::nan("");
  s.wanted_W = wanted_.wanted_power_W;
  s.applied_W = heater_.acting().power_W;
  s.limited = heater_.acting().limited;
  s.proof_off = !settings_.supervision.proof_of_response;
  s.oscillated = wanted_.oscillated;
  s.duty = heater_.set_duty();
  s.supply_V = heater_.supply_V();
  s.current_A = heater_.current().present ? heater_.current().value : std::nan("");
  s.resistance_Ohm = heater_.resistance().value_Ohm();
  s.resistance_age_s = heater_.resistance().age_s();
  s.coldest_C = heater_.heat().coldest_C();
  s.hottest_C = heater_.heat().hottest_C();
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
