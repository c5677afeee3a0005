#include "simulated_board/muscle_channel.hpp"

#include <cmath>

namespace supercoil::host_sim {

MuscleChannel::MuscleChannel(const MuscleChannelSettings& settings, hal::Duration step,
                             const hal::Time& now, std::uint64_t seed)
    : pwm(settings.pwm_steps, hal::duration_from(settings.pwm_delay_s), now),
      position(settings.position, seed),
      current(settings.current, seed + 1000003),
      settings_(settings),
      step_(step),
      plant_(settings.plant, settings.effects, hal::seconds(step)),
      thermometer_(settings.thermometer, settings.rise_from_C, seed + 3000017),
      sense_gain_(settings.sense_filter_s > 0.0
                      ? -std::expm1(-hal::seconds(step) / settings.sense_filter_s)
                      : 1.0) {}

void MuscleChannel::set(const MuscleChannelSettings& settings) {
  if (!(settings.plant == settings_.plant && settings.effects == settings_.effects))
    plant_.set(settings.plant, settings.effects);
  thermometer_.set(settings.thermometer);
  settings_ = settings;
}

double MuscleChannel::position_m() const {
  return shared_ == nullptr ? plant_.position_m() : shared_->position_m(muscle_);
}

double MuscleChannel::reading_m() const {
  return shared_ == nullptr ? plant_.position_m() : shared_->reading_m(muscle_);
}

double MuscleChannel::temperature_rise_K() const {
  return shared_ == nullptr ? plant_.temperature_rise_K() : shared_->temperature_rise_K(muscle_);
}

double MuscleChannel::peak_temperature_rise_K() const {
  return shared_ == nullptr ? plant_.peak_temperature_rise_K()
                            : shared_->peak_temperature_rise_K(muscle_);
}

void MuscleChannel::heat(hal::Time from, double supply_V) {
  const bool enabled = enable.high() || faults.enable_stuck_on;
  const double driven = enabled ? pwm.duty(from) : 0.0;
  const double leaked = faults.switch_stuck_on ? 1.0 : faults.switch_leak_ratio;
  const double duty = driven + (1.0 - driven) * leaked;
  const double warm = 1.0 + settings_.temperature_coefficient_per_K * temperature_rise_K();
  const double resistance_Ohm = settings_.resistance_Ohm * warm;
  const double through_A = faults.wire_open ? 0.0 : duty * supply_V / resistance_Ohm;
  const double beside_A = faults.short_Ohm > 0.0 ? duty * supply_V / faults.short_Ohm : 0.0;
  power_W_ = supply_V * through_A * settings_.power_gain;
  current_A_ = through_A + beside_A;
  sense_A_ += sense_gain_ * (current_A_ - sense_A_);
}

void MuscleChannel::move(hal::Time to) {
  if (shared_ == nullptr) plant_.step(power_W_, settings_.load_N);
  if (settings_.thermometer)
    thermometer_.step(settings_.rise_from_C + temperature_rise_K(), hal::seconds(step_));
  if (!faults.slack) slack_at_m_ = reading_m();
  position.offer(slack_at_m_, to);
  current.offer(sense_A_, to);
}

}  // namespace supercoil::host_sim
