// What a channel finds out about its muscle when it is asked to.
#include <algorithm>

#include "loop/channel.hpp"

namespace supercoil {

void Channel::step_identify() {
  const ModeResult now =
      identify_.step(evidence_.position.value, acting_.power_W, limiter_.max_W());
  // It asks for no more than a hot muscle gets: a slow one may stay hot for minutes, and a power
  // that is cut for so long is a controller's fault.
  wanted_.wanted_power_W = std::min(identify_.power_W(), limiter_.max_W(heat_.hottest_C()));
  follow_cooling();
  if (now == ModeResult::running) return;
  wanted_ = {};
  const bool cooling_found = learn_cooling();
  if (now != ModeResult::found && cooling_found) keep_heat();
  end_mode(now == ModeResult::found ? keep(identify_.found(), calibration_) : now);
}

void Channel::step_calibrate() {
  if (probe_.running()) return;
  const ModeResult now = calibrate_.step(heat_.hottest_K(), evidence_.position.value, step_s_);
  if (now != ModeResult::running) return end_mode(now);
  if (calibrate_.knows_zero()) probe_.start();
}

/// The probe that follows the zero ends calibration. cold_Ohm: 0 when it measured nothing.
void Channel::end_calibrate(double cold_Ohm) {
  const ModeResult now = calibrate_.probed(cold_Ohm);
  if (now != ModeResult::found) return end_mode(now);
  storage::Calibration found = calibration_;
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
                         const storage::Calibration& found) {
  const storage::Learned learned{muscle, found, senses_, 0, true, heat_facts_};
  if (storage::check(learned)) return ModeResult::implausible;
  if (found != calibration_) {
    supervisor_.recalibrated();
    proof_.recalibrated();
  }
  if (!(muscle == muscle_)) proof_.learn(muscle);
  muscle_ = muscle;
  calibration_ = found;
  knows_muscle_ = true;
  return lessons_.push(learned) ? ModeResult::found : ModeResult::not_stored;
}

}  // namespace supercoil
