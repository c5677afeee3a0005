// A channel's senses, compared with a meter that a person reads.
#include "loop/channel.hpp"

namespace supercoil {

namespace {

/// What the senses tell of a resistance, over what they would tell without gains.
double resistance_gain(const board::SenseComparison& senses) {
  return senses.supply_gain / senses.current_gain;
}

}  // namespace

/// Averages what the senses tell while a power is held.
void Channel::follow_comparison() {
  const board::Measured& current = heater_.current();
  const bool sensed = current.present && heater_.supply_V() > 0.0;
  const bool steady = sensed && heater_.allowed().by <= LimitedBy::maximum;
  if (steady) {
    comparison_.step(heater_.acting().duty, heater_.supply_V(), current.value);
  } else {
    comparison_.restart();
  }
  follow_steady_heat(steady);
}

void Channel::restart_comparisons() {
  comparison_.restart();
  steady_heat_.restart();
}

/// What the meter shows. Of the supply, 0 forgets the comparison.
Refusal Channel::compare(board::MeterComparison::Sense sense, double meter) {
  const bool active = state_.state() == State::active;
  if (sense == board::MeterComparison::supply && meter == 0.0)
    return active ? Refusal::wrong_state : go_by({});
  if (!active || mode_ != Mode::power) return Refusal::wrong_state;
  // Not the calibrated resistance: the senses that are in question measured that.
  const Refusal refusal = comparison_.read(sense, meter, heater_.senses(),
                                           heater_.warm_Ohm(settings_.heater.cold_resistance_Ohm));
  if (refusal != Refusal::none) return refusal;
  const auto found = comparison_.found();
  return found ? go_by(*found) : Refusal::none;
}

/// From now on, and kept for the next start. What cannot be kept changes nothing.
Refusal Channel::go_by(const board::SenseComparison& senses) {
  const double more_Ohm = resistance_gain(senses) / resistance_gain(heater_.senses());
  board::Calibration calibration = calibration_;
  // The thermometer was read in what the senses told then.
  board::HeatFacts facts = heater_.facts();
  facts.forget_reading();
  // A learned resistance was told by the senses as they were; a configured one was not.
  if (calibration.cold_resistance_Ohm != settings_.heater.cold_resistance_Ohm)
    calibration.cold_resistance_Ohm *= more_Ohm;
  const board::Learned learned{muscle_,       calibration, senses,       0,
                               knows_muscle_, facts,       answer_ratio_};
  if (board::check(learned)) return Refusal::out_of_range;
  if (!lessons_.push(learned)) return Refusal::too_many;
  calibrate(calibration);
  heater_.go_by(senses, more_Ohm);
  heater_.know(facts);
  proof_.plan(heater_.power_bounds().true_over_told().max, muscle_);
  comparison_.forget();
  restart_comparisons();
  return Refusal::none;
}

}  // namespace supercoil
