// What a channel knows of its muscle.
#include <algorithm>
#include <cmath>
#include <cstdint>

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
  evidence_.current.value *= senses_.current_gain;
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

/// What a heater that is as it was calibrated has at the muscle's coldest and hottest.
board::PowerBounds::Interval Channel::calibrated_Ohm() const {
  const double cold_Ohm = calibration_.cold_resistance_Ohm;
  const double per_K = settings_.heater.temperature_coefficient_per_K;
  return {cold_Ohm * (1.0 + per_K * heat_.coldest_K()),
          cold_Ohm * (1.0 + per_K * heat_.hottest_K())};
}

/// The muscle's temperature, from the power that was set and the one that was measured: if a switch
/// conducts by itself, only the current knows.
void Channel::observe_heat(std::int64_t periods) {
  const board::Measured& current = evidence_.current;
  const bool sensed = current.present && supply_V_ > 0.0;
  if (sensed) resistance_.step(acting_.duty, supply_V_, current.value);
  // Senses that lied while the resistance was calibrated cannot narrow the bounds by that.
  const double as_configured =
      settings_.heater.cold_resistance_Ohm / calibration_.cold_resistance_Ohm;
  const auto [min_Ohm, max_Ohm] = calibrated_Ohm();
  const auto power_W = power_bounds_.step(
      acting_.duty, supply_V_, current,
      {min_Ohm * std::min(1.0, as_configured), max_Ohm * std::max(1.0, as_configured)});
  heat_.step(power_W.min, power_W.max, acting_.power_W, sensed);
  const auto ratio = power_bounds_.true_over_told();
  told_W_ = {power_W.min / ratio.min, power_W.max / ratio.max};
  const double measured_W =
      current.present ? supply_V_ * (current.value - settings_.supervision.current_noise_A)
                      : limiter_.max_W();
  evidence_.measured_W = std::max(acting_.power_W, measured_W);
  // In periods that were left out the power may have gone on, or the charge pump have cut it.
  for (std::int64_t i = 1; i < periods; ++i)
    heat_.step(0.0, power_W.max, acting_.power_W, sensed);

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

void Channel::prove(std::int64_t periods) {
  const bool heats = state_.may_heat() && (mode_ == Mode::position || mode_ == Mode::power);
  const board::Measured& position = evidence_.position;
  proof_.step({acting_.power_W, acting_.dither_W, periods, position.present, position.value,
               heat_.hottest_K(), heats, heat_.air().above_configured_K()});
  evidence_.unanswered = proof_.unanswered();
  if (evidence_.unanswered) evidence_.answer = proof_.margin();
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
