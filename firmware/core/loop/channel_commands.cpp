// What a channel does when it is told to.
#include <algorithm>
#include <cmath>

#include "loop/channel.hpp"

namespace supercoil {

namespace {

/// To whoever wants something kept.
Refusal answer_to(ModeResult kept) {
  if (kept == ModeResult::not_stored) return Refusal::too_many;
  return kept == ModeResult::found ? Refusal::none : Refusal::out_of_range;
}

}  // namespace

Answer Channel::answer(const Command& command, const BoardNow& board) {
  nearest_ = NAN;
  const Refusal refusal = obey(command, board);
  return {command, refusal, nearest_};
}

Refusal Channel::obey(const Command& command, const BoardNow& board) {
  switch (command.verb) {
    case Verb::arm:
      return arm(board);
    case Verb::disarm:
      disarm(Fault::none);
      return Refusal::none;
    case Verb::reset:
      reset_asked_ = true;
      return state_.reset(true, present_fault_ != Fault::none || board.fault != Fault::none);
    case Verb::position:
      return heat(Mode::position, command.value, board);
    case Verb::power:
      return heat(Mode::power, command.value, board);
    case Verb::identify:
      return heat(Mode::identify, 0.0, board);
    case Verb::calibrate:
      return heat(Mode::calibrate, 0.0, board);
    case Verb::renew:
      if (state_.state() != State::active) return Refusal::wrong_state;
      evidence_.renewed = true;
      return Refusal::none;
    case Verb::rest:
      if (state_.rest() != Refusal::none) return Refusal::wrong_state;
      rest();
      return Refusal::none;
    case Verb::scale:
      return scale(command.value);
    case Verb::controller:
      return choose_controller(command.value);
    case Verb::estimator:
      return choose_estimator(command.value);
    case Verb::store:
      return store(command.value);
    case Verb::compare_supply:
      return compare(board::MeterComparison::supply, command.value);
    case Verb::compare_current:
      return compare(board::MeterComparison::current, command.value);
    case Verb::compare_rise:
      return compare_rise(command.value);
    case Verb::none:
      break;
  }
  return Refusal::out_of_range;
}

Refusal Channel::arm(const BoardNow& board) {
  if (state_.state() != State::disarmed) return Refusal::wrong_state;
  const bool measured = evidence_.position.present && heater_.current().present;
  const bool quiet = present_fault_ == Fault::none && board.fault == Fault::none;
  if (!board.proven || !measured || !quiet || !heater_.heat_known()) return Refusal::not_ready;
  state_.arm();
  supervisor_.rearmed();
  heater_.start_probe();
  return Refusal::none;
}

Refusal Channel::heat(Mode mode, double value, const BoardNow& board) {
  const State state = state_.state();
  if (state != State::armed && state != State::active) return Refusal::wrong_state;
  if (!board.proven) return Refusal::not_ready;
  if (state == State::armed && heater_.probing()) return Refusal::busy;
  if (mode == Mode::position) {
    const double max_m = settings_.supervision.max_travel_m;
    const double reachable_m = as_float_tells * max_m;
    const bool reachable = value >= -reachable_m && value <= reachable_m;
    value = std::clamp(value, -max_m, max_m);
    if (!reachable) return refuse_beyond(value);  // a NaN as well
  } else if (mode == Mode::power) {
    if (!std::isfinite(value)) return Refusal::out_of_range;
  } else if (state == State::active) {
    evidence_.renewed = mode == mode_;
    return mode == mode_ ? Refusal::none : Refusal::busy;
  }
  if (state == State::armed) {
    state_.activate();
    estimator().restart();
  }
  if (mode != mode_ || value != reference_) restart_comparisons();
  reference_ = value;
  if (mode != mode_) enter(mode);
  evidence_.renewed = true;
  return Refusal::none;
}

/// The channel becomes active in another mode, or changes it while hot.
void Channel::enter(Mode mode) {
  const bool was_driven = mode_ == Mode::power || mode_ == Mode::position;
  if (!was_driven) smooth_power_W_.set(heater_.acting().power_W);
  smooth_error_m_.set(0.0);
  if (result_ == ModeResult::running) result_ = ModeResult::interrupted;
  mode_ = mode;
  if (mode == Mode::position) {
    control::ControllerStart at = start_here();
    at.motion = {evidence_.position.value, 0.0, 0.0};
    at.position_m = evidence_.position.value;
    at.hold = was_driven;
    start_controller(controller_, at);
  } else if (mode == Mode::identify) {
    identify_.start(evidence_.position.value);
    small_signal_.stop();
    if (cooling_fit_) cooling_fit_->start();
    result_ = ModeResult::running;
  } else if (mode == Mode::calibrate) {
    calibrate_.start();
    result_ = ModeResult::running;
  }
}

/// Where the controller that is at work leaves off. Power and error are smoothed alike: a single
/// tick's carry the sensor's noise times the controller's gain.
control::ControllerStart Channel::start_here() const {
  control::ControllerStart at;
  at.reference_m = reference_;
  at.motion = controllers_[controller_].motion();
  at.position_m = at.motion.position + smooth_error_m_.value();
  at.power_W = smooth_power_W_.value();
  return at;
}

/// With the gains of the muscle that is known by now: one that runs would jump at others.
void Channel::start_controller(std::size_t place, const control::ControllerStart& at) {
  controllers_[place].suit(control::theta_from(muscle_));
  controllers_[place].start(at);
}

void Channel::rest() {
  if (result_ == ModeResult::running) result_ = ModeResult::interrupted;
  mode_ = Mode::rest;
  reference_ = 0.0;
  heater_.rest();
}

Refusal Channel::refuse_place(double place, std::size_t places) {
  return refuse_beyond(std::clamp(place, 0.0, static_cast<double>(places - 1)));
}

Refusal Channel::choose_controller(double place) {
  if (!(place >= 0.0 && place < static_cast<double>(controllers_.size())))
    return refuse_place(place, controllers_.size());
  const auto chosen = static_cast<std::size_t>(place);
  if (mode_ == Mode::position) {
    control::ControllerStart at = start_here();
    at.hold = true;
    start_controller(chosen, at);
  }
  controller_ = chosen;
  return Refusal::none;
}

Refusal Channel::choose_estimator(double place) {
  if (!(place >= 0.0 && place < static_cast<double>(estimators_.size())))
    return refuse_place(place, estimators_.size());
  estimator_ = static_cast<std::size_t>(place);
  estimator().restart();
  estimate_ = estimator().estimate();
  return Refusal::none;
}

Refusal Channel::scale(double true_m) {
  const double measured_m = evidence_.position.value;
  // A controller would jump at the new scale.
  if (mode_ == Mode::position) return Refusal::wrong_state;
  if (!evidence_.position.present) return Refusal::not_ready;
  board::Calibration found = calibration_;
  found.position_scale *= true_m / measured_m;
  return true_m > 0.0 ? answer_to(keep(muscle_, found)) : Refusal::out_of_range;
}

/// A running channel goes on with the muscle that it knows: what was cleared is not known at the
/// next start. What was found of its heat is forgotten at once, as wide bounds are safe.
Refusal Channel::store(double what) {
  if (what == 0.0) {
    if (!lessons_.push(std::nullopt)) return Refusal::too_many;
    knows_muscle_ = false;
    heater_.know({});
    return Refusal::none;
  }
  if (what != 1.0) return Refusal::out_of_range;
  if (!estimate_ || !estimate_->trusted) return Refusal::not_ready;
  const auto muscle = trusted_muscle();
  return muscle ? answer_to(keep(*muscle, calibration_)) : Refusal::out_of_range;
}

}  // namespace supercoil
