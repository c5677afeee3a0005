// How an axis handles its commands.
#include <algorithm>
#include <cmath>

#include "loop/axis.hpp"

namespace supercoil {

namespace {

/// A place between two others is refused like one beyond the last: the nearest is a whole number.
Reply no_such_place(double place, std::size_t places) {
  return {Refusal::out_of_range,
          std::clamp(std::round(place), 0.0, static_cast<double>(places - 1))};
}

bool is_place(double place, std::size_t places) {
  return place >= 0.0 && place < static_cast<double>(places) && place == std::floor(place);
}

}  // namespace

bool Axis::ready() const {
  return inputs_.position.present && heater_.current().present && heater_.heat_known();
}

Reply Axis::admits(Mode mode, double& value) const {
  if (mode == Mode::position) {
    const double max_m = max_travel_m();
    const bool reachable =
        value >= lowest_m(max_reverse_travel_m_) && value <= float_rounding * max_m;
    value = std::clamp(value, min_travel_m(), max_m);
    if (!reachable) return {Refusal::out_of_range, value};  // also for NaN
  } else if (mode == Mode::power) {
    if (!std::isfinite(value)) return Refusal::out_of_range;
  } else if (state_.may_heat() && mode != mode_) {
    return Refusal::busy;
  }
  return Refusal::none;
}

Reply Axis::pull_with(double power_W) {
  const double max_W = std::min(heater_.limiter().max_W(), max_pull_W_);
  const double allowed_W = std::clamp(power_W, 0.0, max_W);
  if (!(power_W >= 0.0 && power_W <= float_rounding * max_W))
    return {Refusal::out_of_range, allowed_W};
  reference_ = allowed_W;
  return Refusal::none;
}

Reply Axis::admits_against(const Axis& other, double power_W) const {
  const bool driven = other.state_.may_heat() && other.mode_ == Mode::power;
  const bool other_is_within = !driven || other.reference_ <= float_rounding * other.max_pull_W_;
  if (other_is_within || power_W <= float_rounding * max_pull_W_) return Refusal::none;
  return {Refusal::out_of_range, max_pull_W_};
}

void Axis::follow(Mode mode, double value) {
  playback_.forget();
  if (mode != mode_ || value != reference_) restart_comparisons();
  reference_ = value;
  if (mode != mode_) enter(mode);
}

/// Changes the mode, as the channel becomes active or while it is hot.
void Axis::enter(Mode mode) {
  const bool was_driven = mode_ == Mode::power || mode_ == Mode::position;
  if (!was_driven) tracking_.set_power(moving_W());
  if (result_ == ModeResult::running) result_ = ModeResult::interrupted;
  mode_ = mode;
  const double position_m = inputs_.position.value;
  if (mode == Mode::position) {
    tracking_.start(position_m, reference_, was_driven, muscle_);
  } else if (mode == Mode::identify) {
    identify_.start(position_m);
    small_signal_.stop();
    if (cooling_fit_) cooling_fit_->start();
    result_ = ModeResult::running;
  } else if (mode == Mode::calibrate) {
    calibrate_.start();
    result_ = ModeResult::running;
  }
}

Reply Axis::play(const Command& command) {
  if (mode_ != Mode::position) return Refusal::wrong_state;
  if (command.verb == Verb::start) {
    constexpr double max_time_s = 9e9;  // fits in 64-bit nanoseconds
    if (!(std::abs(command.value) <= max_time_s)) return Refusal::out_of_range;
    return playback_.start(hal::duration_from(command.value), now_, reference_, command.source);
  }
  return playback_.add(command, {.theta = control::theta_from(muscle_),
                                 .moving_mass_kg = muscle_.moving_mass_kg,
                                 .max_reverse_travel_m = max_reverse_travel_m_,
                                 .max_travel_m = max_travel_m(),
                                 .range = range()});
}

Reply Axis::obey(const Command& command) {
  switch (command.verb) {
    case Verb::scale:
      return scale(command.value);
    case Verb::controller:
      return choose_controller(command.value);
    case Verb::estimator:
      return choose_estimator(command.value);
    case Verb::store:
      return store(command);
    case Verb::tune:
      return tune(command);
    case Verb::compare_supply:
      return compare(board::MeterComparison::supply, command.value);
    case Verb::compare_current:
      return compare(board::MeterComparison::current, command.value);
    case Verb::compare_rise:
      return compare_rise(command.value);
    default:
      return Refusal::out_of_range;
  }
}

Reply Axis::choose_controller(double place) {
  if (!is_place(place, tracking_.controllers()))
    return no_such_place(place, tracking_.controllers());
  const auto chosen = static_cast<std::size_t>(place);
  // It would forget what it has learned.
  if (chosen == tracking_.chosen()) return Refusal::none;
  if (mode_ == Mode::position) {
    tracking_.take_over(chosen, reference_, muscle_);
  } else {
    tracking_.choose(chosen);
  }
  return Refusal::none;
}

/// At once: a following controller continues where its predecessor leaves off; an estimator starts
/// from scratch.
Reply Axis::tune(const Command& command) {
  const bool estimator = command.value >= static_cast<double>(first_estimator_place);
  const auto first = estimator ? static_cast<double>(first_estimator_place) : 0.0;
  const std::size_t places =
      estimator ? std::min(estimation_.estimators(), stored_tuning_.estimators.size())
                : std::min(tracking_.controllers(), stored_tuning_.controllers.size());
  const double place = command.value - first;
  if (!is_place(place, places))
    return {Refusal::out_of_range, first + no_such_place(place, places).nearest};
  const auto at = static_cast<std::size_t>(place);
  if (command.tuned_estimator != nullptr) {
    estimation_.exchange(at, *command.tuned_estimator);
  } else if (command.tuned_controller != nullptr) {
    tracking_.exchange(at, *command.tuned_controller, mode_ == Mode::position, reference_, muscle_);
  } else {
    return Refusal::unsuitable;
  }
  return Refusal::none;
}

Reply Axis::choose_estimator(double place) {
  if (!is_place(place, estimation_.estimators()))
    return no_such_place(place, estimation_.estimators());
  estimation_.choose(static_cast<std::size_t>(place));
  return Refusal::none;
}

Reply Axis::scale(double true_m) {
  const double measured_m = inputs_.position.value;
  // A joint's scale is that of its angle; a bundle uses its leader's.
  if (settings_.joint.turns() || settings_.bundle.follows()) return Refusal::unsuitable;
  // A controller would jump at the new scale.
  if (mode_ == Mode::position) return Refusal::wrong_state;
  // What identify or calibrate has measured so far is in the old scale.
  if (measures(mode_)) return Refusal::busy;
  if (!inputs_.position.present) return Refusal::not_ready;
  board::Calibration found = calibration_;
  found.position_scale *= true_m / measured_m;
  if (!(true_m > 0.0)) return Refusal::out_of_range;
  // A muscle that was identified moves by so much more or less; the configured one is as it is.
  control::PhysicalParameters muscle = muscle_;
  if (!(muscle == settings_.file_muscle())) muscle.force_per_kelvin_N_per_K *= true_m / measured_m;
  const Refusal refusal = refusal_of(keep(muscle, found));
  estimation_.restart();
  // This tick must be judged by the new scale, or it would look like motion in the next one.
  inputs_.position.value = calibrated(inputs_.sensor_m);
  return refusal;
}

/// Averages the senses while a power is held, and waits for steady heat.
void Axis::follow_comparisons() {
  const board::Measured& current = heater_.current();
  const bool sensed = current.present && heater_.supply_V() > 0.0;
  if (!sensed || heater_.cut_by() > LimitedBy::maximum) return restart_comparisons();
  // A probe pulse is not part of the power at which the meter is read.
  if (!heater_.probe_settling())
    comparison_.step(heater_.acting().duty, heater_.supply_V(), current.value);
  if (heater_.senses().compared()) {
    steady_state_.step(heater_.measured_power_W(), heater_.heat().hottest_K());
  } else {
    steady_state_.restart();
  }
}

void Axis::restart_comparisons() {
  comparison_.restart();
  steady_state_.restart();
}

/// meter: its reading. For the supply, 0 clears the comparison.
Refusal Axis::compare(board::MeterComparison::Sense sense, double meter) {
  const bool active = state_.may_heat();
  if (sense == board::MeterComparison::supply && meter == 0.0)
    return active ? Refusal::wrong_state : apply_comparison({});
  if (!holds_power()) return Refusal::wrong_state;
  // Not the calibrated resistance: the senses in question measured it.
  const Refusal refusal = comparison_.read(sense, meter, heater_.senses(),
                                           heater_.warm_Ohm(settings_.heater.cold_resistance_Ohm));
  if (refusal != Refusal::none) return refusal;
  const auto found = comparison_.found();
  return found ? apply_comparison(*found) : Refusal::none;
}

/// rise_K: of the muscle above the air, in steady heat. 0 clears the reading.
Refusal Axis::compare_rise(double rise_K) {
  const bool active = state_.may_heat();
  board::ThermalFacts facts = heater_.facts();
  if (rise_K == 0.0) {
    if (active) return Refusal::wrong_state;
    facts.clear_reading();
  } else {
    if (!holds_power()) return Refusal::wrong_state;
    const Refusal refusal =
        steady_state_.read(rise_K, heater_.power_bounds().true_over_measured(), facts);
    if (refusal != Refusal::none) return refusal;
  }
  if (const Refusal refusal = store_thermal_facts(facts); refusal != Refusal::none) return refusal;
  heater_.set_thermal_facts(facts);
  return Refusal::none;
}

}  // namespace supercoil
