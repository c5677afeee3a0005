// Finds from a feedback's own error how fast it has to be.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace supercoil::control {

/// Lowers a feedback's bandwidth while only sensor noise is left in the error, and raises it again
/// when there is more.
///
/// A loop L = ωc/(s (s/ωl + 1)) leaves the error e. The motion that it caused is known, and so is
/// the error that any other ωc would have left with the same noise and the same disturbances. Six
/// loops are computed beside the running one, each half as fast as the one before. White noise of a
/// reading is independent of all earlier motion, so E[eᵢ²] is the mean square of the true error
/// plus that of the noise, which is the same for all: the loop with the smallest E[eᵢ²] tracks
/// best. Each loop is compared with the one half as fast, over 30 times the reciprocal of the
/// slower one's ωc.
class BandwidthAdaptation {
 public:
  /// The running loop.
  struct Settings {
    double max_rad_per_s = 8.0;   ///< ωc at the start, > 0
    double lag_rad_per_s = 22.0;  ///< ωl, > 0: the mechanics' lag, left by the PID
    double step_s = 1e-3;         ///< of a tick, > 0
  };

  explicit BandwidthAdaptation(const Settings& s)
      : ticks_per_update_(
            std::max<std::int64_t>(1, std::llround(update_angle / s.max_rad_per_s / s.step_s))),
        max_angle_(s.max_rad_per_s * static_cast<double>(ticks_per_update_) * s.step_s),
        lag_smoothing_(
            -std::expm1(-s.lag_rad_per_s * static_cast<double>(ticks_per_update_) * s.step_s)) {}

  /// Restarts at full bandwidth, with nothing learned.
  void restart() {
    ratio_ = 1.0;
    noise_ = error_ = lagged_ = sum_ = 0.0;
    gained_.fill(0.0);
    updates_ = tick_ = 0;
    limited_ = false;
  }

  /// The feedback's gains were multiplied by gain_ratio, and so is its maximum bandwidth.
  void scale(double gain_ratio) { max_angle_ *= gain_ratio; }

  /// One tick. error: measured, in any unit. limited: the applied power was not the demanded one,
  /// so what this or another loop would have moved is unknown.
  void step(double error, bool limited) {
    sum_ += error;
    limited_ = limited_ || limited;
    if (++tick_ < ticks_per_update_) return;
    update(std::exchange(sum_, 0.0) / static_cast<double>(ticks_per_update_),
           std::exchange(limited_, false));
    tick_ = 0;
  }

  /// The bandwidth over its maximum: 1, ½, … 1/32.
  double ratio() const { return ratio_; }

 private:
  struct Loop {
    double error = 0.0;
    double lagged = 0.0;
  };
  static constexpr std::size_t loops = 6;
  /// ωc times the time between updates: 10 ms at 8 rad/s.
  static constexpr double update_angle = 0.08;
  /// Loops stepped more coarsely than this would not behave like real ones.
  static constexpr double max_angle = 0.5;
  static constexpr double memory_angle = 30.0;
  static constexpr std::int64_t first_updates = 50;
  static constexpr double noise_updates = 500.0;
  /// Over the noise's mean square: limit of what a change of the error counts as noise.
  static constexpr double max_noise = 16.0;
  /// An error of eight deviations is not noise: full bandwidth is needed at once.
  static constexpr double max_error = 64.0;
  /// Limit of a difference, over the deviation that noise alone gives it. Otherwise a start or a
  /// change, whose errors are a thousand times as large, would count for minutes.
  static constexpr double max_deviations = 5.0;

  void update(double error, bool limited) {
    const double change = error - error_;
    lagged_ += lag_smoothing_ * (error_ - lagged_);
    const double moved = ratio_ * max_angle_ * lagged_;
    error_ = error;
    learn_noise(0.5 * change * change);
    if (++updates_ < first_updates || limited || max_angle_ > max_angle) {
      for (Loop& loop : loops_)
        loop = {error, lagged_};
      return;
    }
    double angle = max_angle_;
    for (Loop& loop : loops_) {
      loop.lagged += lag_smoothing_ * (loop.error - loop.lagged);
      loop.error += change + moved - angle * loop.lagged;
      angle *= 0.5;
    }
    if (error * error > max_error * noise_) {
      for (double& gained : gained_)
        gained = std::min(gained, 0.0);
    }
    compare();
  }

  void learn_noise(double square) {
    const double share = 1.0 / std::min(static_cast<double>(updates_ + 1), noise_updates);
    const bool known = updates_ >= first_updates;
    noise_ += share * ((known ? std::min(square, max_noise * noise_) : square) - noise_);
  }

  void compare() {
    double angle = max_angle_;
    ratio_ = 1.0;
    bool slower_is_better = true;
    for (std::size_t i = 0; i + 1 < loops; ++i) {
      const double quick = loops_[i].error;
      const double slow = loops_[i + 1].error;
      // Their difference has about angle/2 of the noise's mean square.
      const double deviation = 2.0 * noise_ * std::sqrt(0.5 * angle);
      const double limit = max_deviations * deviation;
      angle *= 0.5;
      gained_[i] += angle / memory_angle *
                    (std::clamp(quick * quick - slow * slow, -limit, limit) - gained_[i]);
      slower_is_better = slower_is_better && gained_[i] > 0.0;
      if (slower_is_better) ratio_ *= 0.5;
    }
  }

  std::int64_t ticks_per_update_;
  double max_angle_;  // ωc times the time between updates
  double lag_smoothing_;
  double ratio_ = 1.0;
  double noise_ = 0.0;   // mean square, of an update's error
  double error_ = 0.0;   // of the last update
  double lagged_ = 0.0;  // the same through the lag
  std::array<Loop, loops> loops_{};
  std::array<double, loops - 1> gained_{};  // mean square, by the loop half as fast
  std::int64_t updates_ = 0;
  std::int64_t tick_ = 0;
  double sum_ = 0.0;  // of the errors since the last update
  bool limited_ = false;
};

}  // namespace supercoil::control
