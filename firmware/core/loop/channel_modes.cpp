// What a channel finds out about its muscle when it is asked to.
#include <algorithm>
#include <cmath>

#include "loop/channel.hpp"

namespace supercoil {

void Channel::step_identify() {
  if (small_signal_.running()) return step_small_signal();
  const ModeResult now =
      identify_.step(evidence_.position.value, heater_.acting().power_W, heater_.limiter().max_W());
  // It asks for no more than a hot muscle gets: a slow one may stay hot for minutes, and a power
  // that is cut for so long is a controller's fault.
  wanted_.wanted_power_W =
      std::min(identify_.power_W(), heater_.limiter().max_W(heater_.heat().hottest_C()));
  follow_cooling();
  if (now == ModeResult::running) return;
  wanted_ = {};
  const bool cooling_found = learn_cooling();
  if (now != ModeResult::found && cooling_found) keep_heat(heater_.facts());
  if (now != ModeResult::found) return end_mode(now);
  const control::PhysicalParameters& muscle = identify_.found();
  const SmallSignal::Settings plan = plan_small_signal(
      proof_.settings(), muscle, identify_.risen_m() / muscle.dc_gain_m_per_W(), 1.0 / step_s_);
  if (!std::isfinite(plan.dither.decided_s)) {
    // What an earlier muscle's small motions were says nothing of this one.
    answer_ratio_ = 0.0;
    return end_mode(keep(muscle, calibration_));
  }
  small_signal_.start(plan, ExpectedMotion(muscle, plan.step_s));
}

/// What a small motion of the muscle that was found leaves at the sensor.
void Channel::step_small_signal() {
  if (small_signal_.step(evidence_.position.value, heater_.acting().power_W)) {
    wanted_.wanted_power_W =
        std::min(small_signal_.power_W(), heater_.limiter().max_W(heater_.heat().hottest_C()));
    return;
  }
  wanted_ = {};
  answer_ratio_ = small_signal_.answer_ratio();
  end_mode(keep(identify_.found(), calibration_));
}

void Channel::step_calibrate() {
  if (heater_.probing()) return;
  const ModeResult now =
      calibrate_.step(heater_.heat().hottest_K(), evidence_.position.value, step_s_);
  if (now != ModeResult::running) return end_mode(now);
  if (calibrate_.knows_zero()) heater_.start_probe();
}

/// The probe that follows the zero ends calibration. cold_Ohm: 0 when it measured nothing.
void Channel::end_calibrate(double cold_Ohm) {
  const ModeResult now = calibrate_.probed(cold_Ohm);
  if (now != ModeResult::found) return end_mode(now);
  board::Calibration found = calibration_;
  found.position_offset_m += calibrate_.zero_m() / calibration_.position_scale;
  found.cold_resistance_Ohm = calibrate_.cold_resistance_Ohm();
  end_mode(keep(muscle_, found));
}

void Channel::end_mode(ModeResult result) {
  result_ = result;
  state_.rest();
  rest();
}

/// A result is used and handed to whoever stores it, unless a quantity in it is out of its range.
ModeResult Channel::keep(const control::PhysicalParameters& muscle,
                         const board::Calibration& found) {
  const board::Learned learned{muscle, found,           heater_.senses(), 0,
                               true,   heater_.facts(), answer_ratio_};
  if (board::check(learned)) return ModeResult::implausible;
  if (found != calibration_) {
    supervisor_.recalibrated();
    proof_.recalibrated();
  }
  const double answer_ratio = answer_ratio_ > 0.0 ? answer_ratio_ : 1.0;
  if (!(muscle == muscle_) || answer_ratio != proof_.settings().answer_ratio)
    proof_.learn(muscle, answer_ratio);
  muscle_ = muscle;
  calibrate(found);
  knows_muscle_ = true;
  return lessons_.push(learned) ? ModeResult::found : ModeResult::not_stored;
}

}  // namespace supercoil
