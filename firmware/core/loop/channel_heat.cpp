// What a channel finds out of its muscle's heat: position and power alone tell its time constant
// only; a weighed mass makes its heat transfer of that, and a thermometer tells it.
#include "loop/channel.hpp"

namespace supercoil {

/// While the muscle is identified. Whether its motion is linear does not matter here.
void Channel::follow_cooling() {
  if (cooling_fit_) cooling_fit_->step(evidence_.position.value, heater_.acting().power_W);
}

/// At the end of identify; whether anything was found.
bool Channel::learn_cooling() {
  if (!cooling_fit_) return false;
  const auto found = cooling_fit_->found();
  if (!found) return false;
  board::HeatFacts facts = heater_.facts();
  facts.time_constant_s = found->time_constant_s;
  facts.time_constant_at_W = found->mean_W;
  // The thermometer may have been read of another muscle.
  const board::KnownHeat known = board::known_heat(settings_.thermal, facts);
  if (facts.was_read() &&
      !board::is_possible(known, facts, heater_.power_bounds().true_over_told()))
    facts.forget_reading();
  heater_.know(facts);
  return true;
}

/// For the next start. What is not kept holds until then.
bool Channel::keep_heat(const board::HeatFacts& facts) {
  const board::Learned learned{muscle_,       calibration_, heater_.senses(), 0,
                               knows_muscle_, facts,        answer_ratio_};
  return !board::check(learned) && lessons_.push(learned);
}

/// Averages the power until the muscle must be in steady heat.
void Channel::follow_steady_heat(bool steady) {
  if (steady && heater_.senses().compared()) {
    steady_heat_.step(heater_.told_W(), heater_.heat().hottest_K());
  } else {
    steady_heat_.restart();
  }
}

/// How much warmer the muscle is than the air, in steady heat. 0 forgets what was read.
Refusal Channel::compare_rise(double rise_K) {
  const bool active = state_.state() == State::active;
  board::HeatFacts facts = heater_.facts();
  if (rise_K == 0.0) {
    if (active) return Refusal::wrong_state;
    facts.forget_reading();
  } else {
    if (!active || mode_ != Mode::power) return Refusal::wrong_state;
    const Refusal refusal =
        steady_heat_.read(rise_K, heater_.power_bounds().true_over_told(), facts);
    if (refusal != Refusal::none) return refusal;
  }
  if (!keep_heat(facts)) return Refusal::too_many;
  heater_.know(facts);
  return Refusal::none;
}

}  // namespace supercoil
