// What a channel finds out of its muscle's heat: position and power alone tell its time constant
// only; a weighed mass makes its heat transfer of that, and a thermometer tells it.
#include "loop/channel.hpp"

namespace supercoil {

/// From now on the bounds are as narrow as what is known.
void Channel::know_heat() {
  storage::HeatFacts facts = heat_facts_;
  // A reading was taken in the power that compared senses told.
  if (!senses_.compared()) facts.forget_reading();
  heat_.know(facts, power_bounds_.true_over_told());
}

/// While the muscle is identified. Whether its motion is linear does not matter here.
void Channel::follow_cooling() {
  if (cooling_fit_) cooling_fit_->step(evidence_.position.value, acting_.power_W);
}

/// At the end of identify; whether anything was found.
bool Channel::learn_cooling() {
  if (!cooling_fit_) return false;
  const auto found = cooling_fit_->found();
  if (!found) return false;
  heat_facts_.time_constant_s = found->time_constant_s;
  heat_facts_.time_constant_at_W = found->mean_W;
  // The thermometer may have been read of another muscle.
  const board::KnownHeat known = board::known_heat(settings_.thermal, heat_facts_);
  if (heat_facts_.was_read() &&
      !board::is_possible(known, heat_facts_, power_bounds_.true_over_told()))
    heat_facts_.forget_reading();
  know_heat();
  return true;
}

/// For the next start. What is not kept holds until then.
bool Channel::keep_heat() {
  const storage::Learned learned{muscle_,       calibration_, senses_,      0,
                                 knows_muscle_, heat_facts_,  answer_ratio_};
  return !storage::check(learned) && lessons_.push(learned);
}

/// Averages the power until the muscle must be in steady heat.
void Channel::follow_steady_heat(bool steady) {
  if (steady && senses_.compared()) {
    steady_heat_.step(told_W_, heat_.hottest_K());
  } else {
    steady_heat_.restart();
  }
}

/// How much warmer the muscle is than the air, in steady heat. 0 forgets what was read.
Refusal Channel::compare_rise(double rise_K) {
  const bool active = state_.state() == State::active;
  storage::HeatFacts facts = heat_facts_;
  if (rise_K == 0.0) {
    if (active) return Refusal::wrong_state;
    facts.forget_reading();
  } else {
    if (!active || mode_ != Mode::power) return Refusal::wrong_state;
    const Refusal refusal = steady_heat_.read(rise_K, power_bounds_.true_over_told(), facts);
    if (refusal != Refusal::none) return refusal;
  }
  const storage::HeatFacts before = heat_facts_;
  heat_facts_ = facts;
  if (!keep_heat()) {
    heat_facts_ = before;
    return Refusal::too_many;
  }
  know_heat();
  return Refusal::none;
}

}  // namespace supercoil
