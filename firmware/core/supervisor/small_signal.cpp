#include "supervisor/small_signal.hpp"

#include <algorithm>
#include <cmath>

namespace supercoil {

void SmallSignal::start(const Settings& settings, const ExpectedMotion& motion) {
  *this = {};
  settings_ = settings;
  motion_ = motion;
  expected_ = measured_ = {settings.dither.corner_rad_per_s, settings.step_s};
  step_ticks_ = std::max<std::int64_t>(1, std::llround(settings.rate_Hz * settings.step_s));
  from_ = static_cast<int>(settings.settle_s / settings.step_s);
  const int period = 2 * settings.dither.half_steps;
  const auto periods_in = [&](double time_s) {
    return static_cast<int>(time_s / (period * settings.step_s));
  };
  const int enough = std::clamp(periods_in(long_s), min_periods, enough_periods);
  // The first period only begins the motion.
  end_ = from_ + (1 + std::max(enough, periods_in(measured_s))) * period;
}

bool SmallSignal::step(double position_m, double applied_W) {
  position_sum_m_ += position_m;
  power_sum_W_ += applied_W;
  if (++ticks_ >= step_ticks_) {
    const auto ticks = static_cast<double>(ticks_);
    end_step(position_sum_m_ / ticks, power_sum_W_ / ticks);
    position_sum_m_ = power_sum_W_ = 0.0;
    ticks_ = 0;
  }
  return running();
}

void SmallSignal::end_step(double position_m, double power_W) {
  if (place_ == 0) measured_.settle(position_m);
  const double expected_m = expected_.step(motion_.step(power_W - settings_.hold_W));
  const double measured_m = measured_.step(position_m);
  if (place_ >= from_ + 2 * settings_.dither.half_steps) {
    expected_m2_ += expected_m * expected_m;
    shared_m2_ += expected_m * measured_m;
  }
  ++place_;
}

double SmallSignal::power_W() const {
  const int place = place_ - from_;
  return settings_.hold_W + (place < 0 ? 0.0 : settings_.dither.step_W(place));
}

double SmallSignal::response_ratio() const {
  constexpr double min_ratio = 0.001;
  constexpr double max_ratio = 10.0;
  const double needed_m = detectors::Response::needed_deviations * settings_.noise_m;
  if (expected_m2_ <= needed_m * needed_m) return 0.0;
  return std::clamp(shared_m2_ / expected_m2_, min_ratio, max_ratio);
}

}  // namespace supercoil
