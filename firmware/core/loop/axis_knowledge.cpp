// What an axis knows of its muscle and passes to the storage worker.
#include <cmath>
#include <tuple>
#include <utility>

#include "loop/axis.hpp"

namespace supercoil {

namespace {

/// A measured resistance over its value without the senses' gains.
double resistance_gain(const board::SenseComparison& senses) {
  return senses.supply_gain / senses.current_gain;
}

}  // namespace

/// The answer to a command to store something.
Refusal Axis::refusal_of(ModeResult kept) {
  if (kept == ModeResult::not_stored) return Refusal::queue_full;
  return kept == ModeResult::found ? Refusal::none : Refusal::out_of_range;
}

board::Learned Axis::known() const {
  return {muscle_,         calibration_,    heater_.senses(), 0,
          has_muscle_,     heater_.facts(), response_ratio_,  unexplained_ratio_,
          identification_, stored_tuning_};
}

void Axis::publish_muscle() {
  published_muscle_.set(known_muscle(muscle_, calibration_, response_ratio_, unexplained_ratio_,
                                     identification_,
                                     configured_muscle(settings_, min_travel_m())));
}

void Axis::calibrate(const board::Calibration& calibration) {
  calibration_ = calibration;
  heater_.calibrate(calibration.cold_resistance_Ohm);
  publish_muscle();
}

/// What was cleared is used until the next start, but must not be stored again with a calibration.
void Axis::forget_muscle(board::Learned& learned) const {
  learned.muscle = settings_.file_muscle();
  learned.response_ratio = learned.unexplained_ratio = 0.0;
  learned.identification = {};
}

/// Uses a result and passes it to the storage worker, unless one of its quantities is out of range.
ModeResult Axis::keep(const control::PhysicalParameters& muscle, const board::Calibration& found) {
  board::Learned learned = known();
  learned.muscle = muscle;
  learned.calibration = found;
  learned.has_muscle = true;
  if (board::check(learned)) return ModeResult::implausible;
  if (cleared_) forget_muscle(learned);
  const double before_m = inputs_.position.value;
  const double before_scale = calibration_.position_scale;
  const bool recalibrated = found != calibration_;
  const double response_ratio = response_ratio_ > 0.0 ? response_ratio_ : 1.0;
  const bool another = !(muscle == muscle_);
  if (another || response_ratio != proof_.settings().response_ratio)
    proof_.learn(muscle, response_ratio);
  if (another) {
    // At once, as at the next start.
    heater_.set_muscle(muscle);
    inputs_.expected_jumped = true;
  }
  muscle_ = muscle;
  ++knowledge_;
  calibrate(found);
  if (recalibrated) {
    const detectors::Recalibration change{before_m, calibrated(inputs_.sensor_m),
                                          found.position_scale / before_scale};
    inputs_.recalibrated = inputs_.recalibrated ? inputs_.recalibrated->then(change) : change;
    proof_.recalibrated();
  }
  has_muscle_ = true;
  return learned_updates_.push(learned) ? ModeResult::found : ModeResult::not_stored;
}

/// At the latest when the next tick is judged. The cold resistance remains this heater's own.
void Axis::follow_knowledge(const Axis& leader) {
  if (leader_knowledge_ == leader.knowledge_) return;
  leader_knowledge_ = leader.knowledge_;
  if (!(muscle_ == leader.muscle_)) heater_.set_muscle(leader.muscle_);
  muscle_ = leader.muscle_;
  board::Calibration found = leader.calibration_;
  found.cold_resistance_Ohm = calibration_.cold_resistance_Ohm;
  calibrate(found);
  inputs_.position.value = calibrated(inputs_.sensor_m);
  inputs_.recalibrated = leader.inputs_.recalibrated;
  inputs_.expected_jumped = leader.inputs_.expected_jumped;
}

/// Keeps a muscle together with how well it was fitted.
ModeResult Axis::keep_fitted(const control::PhysicalParameters& muscle, double unexplained_ratio,
                             const board::Identification& identification) {
  const auto before = std::tuple(unexplained_ratio_, identification_, cleared_);
  unexplained_ratio_ = unexplained_ratio;
  identification_ = identification;
  cleared_ = false;
  const ModeResult kept = keep(muscle, calibration_);
  if (kept == ModeResult::implausible)
    std::tie(unexplained_ratio_, identification_, cleared_) = before;
  return kept;
}

/// Stores them for the next start. What identify found is used until then even if it cannot be
/// stored.
Refusal Axis::store_thermal_facts(const board::ThermalFacts& facts) {
  board::Learned learned = known();
  learned.heat = facts;
  const bool kept = !board::check(learned) && learned_updates_.push(learned);
  return kept ? Refusal::none : Refusal::queue_full;
}

/// Applies a comparison from now on and stores it. If it cannot be stored, nothing changes.
Refusal Axis::apply_comparison(const board::SenseComparison& senses) {
  const double resistance_scale = resistance_gain(senses) / resistance_gain(heater_.senses());
  board::Learned learned = known();
  learned.senses = senses;
  // The thermometer reading belongs to a power by the previous gains.
  learned.heat.clear_reading();
  // A learned resistance was measured with the previous gains; a configured one was not.
  double& cold_Ohm = learned.calibration.cold_resistance_Ohm;
  if (cold_Ohm != settings_.heater.cold_resistance_Ohm) cold_Ohm *= resistance_scale;
  if (board::check(learned)) return Refusal::out_of_range;
  if (!learned_updates_.push(learned)) return Refusal::queue_full;
  calibrate(learned.calibration);
  heater_.apply_comparison(senses, resistance_scale);
  heater_.set_thermal_facts(learned.heat);
  plan_proof();
  comparison_.forget();
  restart_comparisons();
  return Refusal::none;
}

/// A running channel keeps its muscle after a clear, until the next start. What was learned of its
/// heat is cleared at once, as wide bounds are safe.
Refusal Axis::store(const Command& command) {
  const double what = command.value;
  if (what == store_tuning || what == clear_tuning) return keep_tuning(command);
  if (what == 0.0) {
    if (!learned_updates_.push(std::nullopt)) return Refusal::queue_full;
    has_muscle_ = false;
    cleared_ = true;
    heater_.set_thermal_facts({});
    return Refusal::none;
  }
  if (what != 1.0) return Refusal::out_of_range;
  if (!estimation_.trusted()) return Refusal::not_ready;
  const auto muscle = estimation_.trusted_muscle(muscle_);
  if (!muscle) return Refusal::out_of_range;
  // How well an earlier identify explained its strokes says nothing about this muscle.
  return refusal_of(keep_fitted(*muscle, 0.0, {}));
}

/// Stores the values of controllers and estimators and which are chosen, or clears both.
Refusal Axis::keep_tuning(const Command& command) {
  if (command.tuning == nullptr) return Refusal::busy;
  board::Learned learned = known();
  learned.tuning = *command.tuning;
  if (command.value == store_tuning) {
    learned.tuning.controller = static_cast<double>(tracking_.chosen());
    learned.tuning.estimator = static_cast<double>(estimation_.chosen());
  }
  if (board::check(learned) || !learned_updates_.push(learned)) return Refusal::queue_full;
  stored_tuning_ = learned.tuning;
  return Refusal::none;
}

}  // namespace supercoil
