#include "simulated_board/converter.hpp"

#include <algorithm>
#include <cmath>

namespace supercoil::host_sim {

namespace {

/// Rounds halves up; for values from 0 to 2^30. std::lround would be a call, three times a tick.
std::int32_t nearest(double value) {
  const auto whole = static_cast<std::int32_t>(value);
  return whole + (value - whole >= 0.5 ? 1 : 0);
}

}  // namespace

std::int32_t SimulatedConverter::convert(double value) {
  // Pulled to a rail below the sensor's range.
  if (faults_.loose) return static_cast<std::int32_t>(-0.2 * full_scale_);
  if (faults_.frozen && last_.status == hal::Status::ok) return last_.counts;
  double reading = faults_.gain * value + faults_.offset;
  if (settings_.noise_rms > 0.0) reading += settings_.noise_rms * normal_(generator_);
  return nearest(std::clamp((reading - settings_.low) * counts_per_unit_, 0.0, full_scale_));
}

void SimulatedConverter::offer(double value, hal::Time now) {
  value_ = value;
  now_ = now;
  converted_ = false;
  if (period_ <= hal::Duration{} || now < next_ || faults_.silent) return;
  next_ += period_;
  if (next_ <= now) next_ = now + period_;
  pending_.push_back({convert(value), now, hal::Status::ok});
}

hal::Sample SimulatedConverter::latest() {
  if (faults_.status != hal::Status::ok) return {0, now_, faults_.status};
  if (period_ <= hal::Duration{} && !converted_ && !faults_.silent) {
    last_.counts = convert(value_);
    last_.taken = now_;
    last_.status = hal::Status::ok;
    converted_ = true;
  } else {
    while (!pending_.empty() && pending_.front().taken + latency_ <= now_) {
      last_ = pending_.front();
      pending_.pop_front();
    }
  }
  // Member by member, as it was written: a copy in one piece would wait for the store buffer, which
  // took 2 % of a tick's time.
  return {last_.counts, last_.taken, last_.status};
}

}  // namespace supercoil::host_sim
