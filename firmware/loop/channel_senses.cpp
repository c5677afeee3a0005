// What a channel knows of its muscle.
#include <algorithm>
#include <cmath>

#include "loop/channel.hpp"

namespace supercoil {

namespace {

/// A resistance of so many times the cold one is a broken wire and the sense's own offset.
constexpr double as_good_as_open = 4.0;

}  // namespace

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
  const double least_W = std::min(told_W, measured_W) - supply_V * noise_A;
  const double most_W = differs ? std::max(told_W, measured_W) : told_W;
  heat_.step(std::max(0.0, least_W), most_W, told_W);
  // In periods that were left out the power may have gone on, or the charge pump have cut it.
  for (long i = 1; i < periods; ++i)
    heat_.step(0.0, most_W, told_W);
  evidence_.most_W = most_W;

  const double per_K = settings_.heater.temperature_coefficient_per_K;
  evidence_.from_resistance_K = evidence_.from_position_K = 0.0;
  if (per_K > 0.0 && resistance_.age_s() < 1.0) {
    const double warm = resistance_.value_Ohm() / calibration_.cold_resistance_Ohm;
    evidence_.from_resistance_K = (warm - 1.0) / per_K;
    evidence_.from_position_K = evidence_.position.value / heat_.metres_per_K();
  }
}

void Channel::follow_probe(double supply_V) {
  evidence_.probed = evidence_.probe_failed = false;
  const auto probed = probe_.step(resistance_.duty(), supply_V,
                                  evidence_.current.present ? evidence_.current.value : 0.0);
  if (!probed.ended) return;
  const double most_Ohm = as_good_as_open * calibration_.cold_resistance_Ohm;
  evidence_.probe_failed = !(probed.resistance_Ohm > 0.0 && probed.resistance_Ohm < most_Ohm);
  evidence_.probed = !evidence_.probe_failed;
  if (evidence_.probed) resistance_.set(probed.resistance_Ohm);
}

std::optional<control::PhysicalParameters> Channel::trusted_muscle() const {
  if (!estimate_ || !estimate_->trusted) return std::nullopt;
  return control::physical_from(estimate_->theta,
                                {muscle_.force_per_kelvin_N_per_K, muscle_.moving_mass_kg});
}

void Channel::learn_heat() {
  if (const auto muscle = trusted_muscle()) heat_.learn(muscle->thermal_pole_rad_per_s());
}

}  // namespace supercoil
