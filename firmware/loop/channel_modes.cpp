// What a channel finds out about its muscle when it is asked to.
#include "loop/channel.hpp"

namespace supercoil {

void Channel::step_identify() {
  wanted_.wanted_power_W = identify_.power_W(limiter_.max_W());
  const auto outcome = identify_.step(evidence_.position.value, acting_.power_W);
  if (outcome == modes::Identify::Outcome::running) return;
  if (outcome == modes::Identify::Outcome::found) keep(identify_.found(), calibration_);
  wanted_ = {};
  state_.rest();
  rest();
}

void Channel::step_calibrate() {
  if (probe_.running()) return;
  switch (calibrate_.step(heat_.hottest_K(), evidence_.position.value, step_s_)) {
    case modes::Calibrate::Outcome::probe:
      probe_.start();
      break;
    case modes::Calibrate::Outcome::failed:
      state_.rest();
      rest();
      break;
    case modes::Calibrate::Outcome::running:
    case modes::Calibrate::Outcome::found:
      break;
  }
}

/// The probe that follows the zero ends calibration. cold_Ohm: 0 when it measured nothing.
void Channel::end_calibrate(double cold_Ohm) {
  if (calibrate_.probed(cold_Ohm) == modes::Calibrate::Outcome::found) {
    storage::Calibration found = calibration_;
    found.position_offset_m += calibrate_.zero_m() / calibration_.position_scale;
    found.cold_resistance_Ohm = calibrate_.cold_resistance_Ohm();
    keep(muscle_, found);
  }
  state_.rest();
  rest();
}

/// A result is used and handed to whoever stores it, unless a quantity in it is out of its range.
bool Channel::keep(const control::PhysicalParameters& muscle, const storage::Calibration& found) {
  const storage::Learned learned{muscle, found, 0};
  if (storage::check(learned)) return false;
  if (found != calibration_) supervisor_.restart();  // every position moves with it
  muscle_ = muscle;
  calibration_ = found;
  return lessons_.push(learned);
}

}  // namespace supercoil
