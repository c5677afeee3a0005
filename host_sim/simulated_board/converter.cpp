#include "simulated_board/converter.hpp"

#include <algorithm>
#include <cmath>

namespace supercoil::host_sim {

hal::Sample SimulatedConverter::convert(double value, hal::Time when) {
  hal::Sample sample{0, when, hal::Status::ok};
  if (trouble_.loose) {
    // Pulled to a rail below everything that the sensor gives.
    sample.counts = static_cast<std::int32_t>(-0.2 * full_scale_);
  } else if (trouble_.frozen && last_.status == hal::Status::ok) {
    sample.counts = last_.counts;
  } else {
    double reading = value + trouble_.offset;
    if (settings_.noise_rms > 0.0) reading += settings_.noise_rms * normal_(generator_);
    const double counts = (reading - settings_.low) * counts_per_unit_;
    sample.counts = static_cast<std::int32_t>(std::lround(std::clamp(counts, 0.0, full_scale_)));
  }
  return sample;
}

void SimulatedConverter::offer(double value, hal::Time now) {
  value_ = value;
  now_ = now;
  converted_ = false;
  if (period_ <= hal::Duration{} || now < next_ || trouble_.silent) return;
  next_ = now + period_;
  on_the_way_.push_back(convert(value, now));
}

hal::Sample SimulatedConverter::latest() {
  if (trouble_.status != hal::Status::ok) return {0, now_, trouble_.status};
  if (period_ <= hal::Duration{} && !converted_ && !trouble_.silent) {
    const hal::Sample sample = convert(value_, now_);
    last_ = sample;
    converted_ = true;
    return sample;
  }
  while (!on_the_way_.empty() && on_the_way_.front().taken + latency_ <= now_) {
    last_ = on_the_way_.front();
    on_the_way_.pop_front();
  }
  return last_;
}

}  // namespace supercoil::host_sim
