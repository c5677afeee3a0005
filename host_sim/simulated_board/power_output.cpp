#include "simulated_board/power_output.hpp"

#include <algorithm>
#include <cmath>

#include "supercoil/control/tracking/law.hpp"

namespace supercoil::host_sim {

PowerOutput::PowerOutput(const PowerSettings& settings, double step_s) : step_s_(step_s) {
  set(settings);
}

void PowerOutput::set(const PowerSettings& settings) {
  settings_ = settings;
  const double ticks = std::nearbyint(settings.delay_s / step_s_);
  delay_ticks_ =
      static_cast<std::size_t>(std::clamp(ticks, 0.0, static_cast<double>(longest_delay_ticks)));
}

double PowerOutput::quantised(double power_W) {
  const double steps = std::ldexp(1.0, settings_.pwm_bits) - 1.0;
  const double per_W = steps / settings_.full_scale_W;
  // The limits hold for the power that is given, not only for the one that is asked for.
  const double least = std::ceil(settings_.min_W * per_W);
  const double most = std::floor(settings_.max_W * per_W);
  const double exact = power_W * per_W + rounding_error_;
  const double duty = std::clamp(std::nearbyint(exact), least, most);
  rounding_error_ = settings_.error_feedback ? std::clamp(exact - duty, -1.0, 1.0) : 0.0;
  return duty / per_W;
}

void PowerOutput::want(double power_W) {
  const double clipped = control::PowerRange{settings_.min_W, settings_.max_W}.clip(power_W);
  Command& newest = line_[head_];
  newest.limited = clipped != power_W;
  newest.power_W = settings_.pwm_bits > 0 ? quantised(clipped) : clipped;
  acting_ = line_[(head_ + line_.size() - delay_ticks_) % line_.size()];
  head_ = (head_ + 1) % line_.size();
}

}  // namespace supercoil::host_sim
