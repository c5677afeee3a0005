// Figures of a run that are collected tick by tick.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace supercoil::host_sim {

/// Root mean square and largest value of the errors added.
class ErrorMeter {
 public:
  void add(double error) {
    square_sum_ += error * error;
    max_ = std::max(max_, std::abs(error));  // ignores NaN
    ++count_;
  }
  double square_sum() const { return square_sum_; }
  double rms() const { return std::sqrt(square_sum_ / static_cast<double>(count_)); }
  double max() const { return max_; }
  std::int64_t count() const { return count_; }

 private:
  double square_sum_ = 0.0;
  double max_ = 0.0;
  std::int64_t count_ = 0;
};

/// How large a motion is.
class MotionMeter {
 public:
  void add(double position_m) {
    // Differences from the first position lose no digits.
    if (count_++ == 0) first_m_ = position_m;
    const double from_first_m = position_m - first_m_;
    sum_m_ += from_first_m;
    square_sum_m2_ += from_first_m * from_first_m;
  }
  /// Rms about the mean; for a motion that hardly moves, a fraction of how far it is held.
  double size_m() const {
    const auto count = static_cast<double>(count_);
    const double mean_m = sum_m_ / count;
    const double spread_m = std::sqrt(std::fmax(0.0, square_sum_m2_ / count - mean_m * mean_m));
    return std::fmax(spread_m, held_ratio * std::abs(first_m_ + mean_m));
  }

 private:
  static constexpr double held_ratio = 0.2;

  double first_m_ = 0.0;
  double sum_m_ = 0.0;
  double square_sum_m2_ = 0.0;
  std::int64_t count_ = 0;
};

/// How far a controller's power swings with noise, which is faster than any motion and always
/// there: the median of each second's rms, which a step does not change.
class PowerNoiseMeter {
 public:
  void add(double time_s, double power_W) {
    const double step_s = time_s - last_s_;
    last_s_ = std::isfinite(power_W) ? time_s : NAN;
    if (!(step_s > 0.0 && step_s < window_s) || std::isnan(last_s_)) return begin(time_s, power_W);
    trend_W_ += step_s / (trend_s + step_s) * (power_W - trend_W_);
    meter_.add(power_W - trend_W_);
    if (time_s - from_s_ < window_s) return;
    windows_W_.push_back(meter_.rms());
    meter_ = {};
    from_s_ = time_s;
  }
  void interrupt() { last_s_ = NAN; }
  /// NaN: a position was followed for too short a time.
  double rms_W() const {
    constexpr std::size_t min_windows = 5;
    if (windows_W_.size() < min_windows) return NAN;
    std::vector<double> sorted = windows_W_;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    return *middle;
  }

 private:
  static constexpr double window_s = 1.0;
  static constexpr double trend_s = 0.05;

  void begin(double time_s, double power_W) {
    from_s_ = time_s;
    trend_W_ = power_W;
    meter_ = {};
  }

  double last_s_ = NAN;
  double from_s_ = 0.0;
  double trend_W_ = 0.0;
  ErrorMeter meter_;
  std::vector<double> windows_W_;
};

}  // namespace supercoil::host_sim
