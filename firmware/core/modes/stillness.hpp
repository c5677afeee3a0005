// Whether a muscle that gets no power has come to rest.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

namespace supercoil::modes {

/// Compares the mean position over a second with an earlier one. A muscle whose heat has fallen to
/// the ratio r of its earlier heat has moved by x (1 - r), where x is all the motion that the
/// earlier heat caused; x r of it is left. The max r is that of the hottest that the muscle may be.
class Stillness {
 public:
  /// mean_s: > 0. count_m: the sensor's resolution, below which no motion is seen.
  Stillness(double mean_s, double count_m) : mean_s_(mean_s), count_m_(count_m) {}

  /// One tick without power. hottest_K: the hottest that the muscle may be above the air, > 0.
  void step(double hottest_K, double position_m, double step_s) {
    if (count_ == 0) shift_m_ = position_m;
    const double shifted_m = position_m - shift_m_;
    sum_m_ += shifted_m;
    square_sum_m2_ += shifted_m * shifted_m;
    ++count_;
    elapsed_s_ += step_s;
    if (elapsed_s_ < mean_s_) return;
    const Mean now = mean(hottest_K);
    if (!begun_) first_ = next_ = now;
    begun_ = true;
    last_ = now;
    if (now.hottest_K * compared_ratio <= next_.hottest_K) {
      first_ = next_;
      next_ = now;
    }
    count_ = 0;
    elapsed_s_ = sum_m_ = square_sum_m2_ = 0.0;
  }

  /// How far the muscle may still move as it cools; infinity: not known yet.
  double remaining_m() const {
    const double cooled = first_.hottest_K / last_.hottest_K - 1.0;
    if (!begun_ || !(cooled > 0.0)) return std::numeric_limits<double>::infinity();
    constexpr double deviations = 4.0;
    const double uncertain_m =
        count_m_ + deviations * std::sqrt(first_.variance_m2 + last_.variance_m2);
    return (std::abs(last_.position_m - first_.position_m) + uncertain_m) / cooled;
  }

 private:
  /// The earlier mean is from when the hottest was this many times as hot, up to its square.
  static constexpr double compared_ratio = 2.5;
  /// Min independent readings in a mean, however slowly the sensor is read and filtered.
  static constexpr double independent = 50.0;

  struct Mean {
    double position_m = 0.0;
    double variance_m2 = 0.0;  ///< of the mean
    double hottest_K = 0.0;
  };
  Mean mean(double hottest_K) const {
    const auto n = static_cast<double>(count_);
    const double mean_m = sum_m_ / n;
    const double variance_m2 = std::fmax(0.0, square_sum_m2_ / n - mean_m * mean_m);
    return {shift_m_ + mean_m, variance_m2 / independent, hottest_K};
  }

  double mean_s_;
  double count_m_;
  std::int64_t count_ = 0;
  double elapsed_s_ = 0.0;
  double shift_m_ = 0.0;  ///< near the readings, so that their squares keep their digits
  double sum_m_ = 0.0;
  double square_sum_m2_ = 0.0;
  bool begun_ = false;
  Mean first_;  ///< compared with last_
  Mean next_;   ///< the next first_
  Mean last_;
};

}  // namespace supercoil::modes
