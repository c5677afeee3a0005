// What a channel knows of its muscle.
#include <cstdint>

#include "loop/channel.hpp"

namespace supercoil {

void Channel::sample(hal::Time now) {
  evidence_.renewed = evidence_.obeyed_command = evidence_.refused_command = false;
  reset_asked_ = false;
  sample_position(now);
  heater_.sample(now);
}

void Channel::sample_position(hal::Time now) {
  const hal::Sample sample = sensor_->latest();
  const InputSettings& input = settings_.position;
  board::Measured& position = evidence_.position;
  board::measure(sample, input.scaling, now, input.max_age_s, position);
  evidence_.sensor_m = position.value;
  position.value = (position.value - calibration_.position_offset_m) * calibration_.position_scale;
  const bool fresh = position.present && sample.taken != position_taken_;
  evidence_.position_elapsed_s = fresh ? hal::seconds(sample.taken - position_taken_) : 0.0;
  if (fresh) position_taken_ = sample.taken;
}

void Channel::prove(std::int64_t periods) {
  const bool heats = state_.may_heat() && (mode_ == Mode::position || mode_ == Mode::power);
  const board::Measured& position = evidence_.position;
  const board::AppliedPower& acting = heater_.acting();
  const board::Heat& heat = heater_.heat();
  proof_.step({acting.power_W, acting.dither_W, periods, position.present, position.value,
               heat.hottest_K(), heats, heat.air().above_configured_K()});
  evidence_.unanswered = proof_.unanswered();
  if (evidence_.unanswered) evidence_.answer = proof_.margin();
}

std::optional<control::PhysicalParameters> Channel::trusted_muscle() const {
  if (!estimate_ || !estimate_->trusted) return std::nullopt;
  return control::physical_from(estimate_->theta,
                                {muscle_.force_per_kelvin_N_per_K, muscle_.moving_mass_kg});
}

void Channel::learn_heat() {
  if (const auto muscle = trusted_muscle()) heater_.learn(muscle->thermal_pole_rad_per_s());
}

}  // namespace supercoil
