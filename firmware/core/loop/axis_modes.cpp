// How an axis measures its muscle on command: identify and calibrate.
#include <algorithm>
#include <cmath>
#include <utility>

#include "loop/axis.hpp"

namespace supercoil {

namespace {

/// Without a date, which is added when it is stored.
board::Identification identification_of(const modes::Identify::Quality& quality) {
  constexpr double max_ratio = 10.0;
  board::Identification of;
  for (std::size_t i = 0; i < of.deviation_ratio.size(); ++i) {
    const double ratio = quality.deviation_ratio[static_cast<Eigen::Index>(i)];
    of.deviation_ratio[i] = std::isnan(ratio) ? 0.0 : std::fmin(ratio, max_ratio);
  }
  return of;
}

}  // namespace

bool Axis::step_identify() {
  if (small_signal_.running()) return step_small_signal();
  const ModeResult now = identify_.step(inputs_.position.value, moving_W(), max_W());
  // Identify asks for no more than a hot muscle gets: a slow one may stay hot for minutes, and
  // power that is limited for so long counts as a controller's fault.
  demanded_.demanded_power_W = std::min(identify_.power_W(), max_hot_W());
  update_cooling_fit();
  if (now == ModeResult::running) return false;
  demanded_ = {};
  const bool cooling_found = learn_cooling();
  if (now != ModeResult::found && cooling_found) store_thermal_facts(heater_.facts());
  if (now != ModeResult::found) return end_mode(now);
  const control::PhysicalParameters& muscle = identify_.found();
  const double gain_m_per_W = muscle.dc_gain_m_per_W();
  const SmallSignal::Settings plan =
      plan_small_signal(proof_.settings(), muscle, identify_.risen_m() / gain_m_per_W,
                        identify_.reach_m() / gain_m_per_W, 1.0 / step_s_);
  if (!std::isfinite(plan.dither.decided_s)) {
    // The response of an earlier muscle says nothing about this one.
    return end_mode(keep_identified(0.0));
  }
  small_signal_.start(plan, ExpectedMotion(muscle, plan.step_s));
  return false;
}

/// Measures how much of a small motion of the muscle that was found reaches the sensor.
bool Axis::step_small_signal() {
  if (small_signal_.step(inputs_.position.value, moving_W())) {
    demanded_.demanded_power_W = std::min(small_signal_.power_W(), max_hot_W());
    return false;
  }
  demanded_ = {};
  return end_mode(keep_identified(small_signal_.response_ratio()));
}

ModeResult Axis::keep_identified(double response_ratio) {
  const auto& quality = identify_.quality();
  const double before = std::exchange(response_ratio_, response_ratio);
  const ModeResult kept =
      keep_fitted(identify_.found(), quality.unexplained_ratio, identification_of(quality));
  if (kept == ModeResult::implausible) response_ratio_ = before;
  return kept;
}

/// The fit does not need a linear motion.
void Axis::update_cooling_fit() {
  // Short strokes of a strongly nonlinear muscle give a time constant that is too short.
  if (cooling_fit_ && !identify_.shortened())
    cooling_fit_->step(inputs_.position.value, moving_W());
}

/// Position and power alone give only the muscle's time constant; a weighed mass turns it into the
/// heat transfer. At the end of identify; returns whether anything was found.
bool Axis::learn_cooling() {
  if (!cooling_fit_) return false;
  const auto found = cooling_fit_->found();
  if (!found) return false;
  board::ThermalFacts facts = heater_.facts();
  facts.time_constant_s = found->time_constant_s;
  facts.time_constant_at_W = found->mean_W;
  // The thermometer reading may belong to another muscle.
  const board::KnownThermalBounds known = board::known_thermal_bounds(settings_.thermal, facts);
  if (facts.has_reading() &&
      !board::is_possible(known, facts, heater_.power_bounds().true_over_measured()))
    facts.clear_reading();
  heater_.set_thermal_facts(facts);
  return true;
}

bool Axis::step_calibrate() {
  if (heater_.probing()) return false;
  // The others of a joint or a bundle move it as well.
  const double others_K = bundle_ ? bundle_->hottest_K : other_.hottest_K;
  const double hottest_K = std::max(heater_.heat().hottest_K(), others_K);
  const ModeResult now = calibrate_.step(hottest_K, inputs_.position.value, step_s_);
  if (now != ModeResult::running) return end_mode(now);
  if (calibrate_.knows_zero()) heater_.start_probe();
  return false;
}

bool Axis::end_probe() {
  if (mode_ != Mode::calibrate || !heater_.probe_ended()) return false;
  const ModeResult now = calibrate_.probed(heater_.probed_Ohm());
  if (now != ModeResult::found) return end_mode(now);
  board::Calibration found = calibration_;
  // A bundle uses its leader's zero.
  if (!settings_.bundle.follows()) {
    found.position_offset_m +=
        settings_.joint.reading_of_position_m(calibrate_.zero_m()) / calibration_.position_scale;
  }
  found.cold_resistance_Ohm = calibrate_.cold_resistance_Ohm();
  return end_mode(keep(muscle_, found));
}

bool Axis::end_mode(ModeResult result) {
  result_ = result;
  rest();
  return true;
}

}  // namespace supercoil
