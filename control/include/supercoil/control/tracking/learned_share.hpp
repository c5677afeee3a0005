// The share of what was learned that a law should use.
#pragma once

#include <algorithm>
#include <cmath>

namespace supercoil::control {

/// The largest share that would have predicted the power no worse than nothing learned. z is the
/// power that the believed muscle does not explain, d what the weights learned some seconds before
/// add to it. The largest s in [0, 1] with E(z − s d)² ≤ E z² is 2 E[z d]/E[d²]. Only components of
/// z and d faster than trend_s count, since the feedback's integral has the rest. No observation
/// counts for much more than a usual one: otherwise the first seconds after a change of the muscle
/// would dominate for minutes.
class LearnedShare {
 public:
  /// All > 0.
  struct Settings {
    double period_s;         ///< between steps
    double min_W;            ///< of a power large enough to count
    double trend_s = 2.0;    ///< for a muscle with a thermal time constant of 1.95 s
    double memory_s = 60.0;  ///< the same
  };

  /// slowness: of the muscle.
  LearnedShare(const Settings& s, double slowness)
      : min_W2_(s.min_W * s.min_W),
        trend_smoothing_(s.period_s / (s.trend_s * slowness)),
        memory_smoothing_(s.period_s / (s.memory_s * slowness)),
        prior_weight_(1.0 / s.period_s) {}

  /// Uses all of it, until there are data.
  void restart() { cross_sum_ = square_sum_ = 0.0; }

  /// One observation. validate: it says something about the muscle.
  void step(double residual_W, double learned_W, bool validate) {
    residual_trend_W_ += trend_smoothing_ * (residual_W - residual_trend_W_);
    learned_trend_W_ += trend_smoothing_ * (learned_W - learned_trend_W_);
    if (!validate) return;
    const double z = residual_W - residual_trend_W_;
    const double d = learned_W - learned_trend_W_;
    const double size_W2 = z * z + d * d;
    mean_square_W2_ += memory_smoothing_ *
                       (std::min(size_W2, max_ratio * mean_square_W2_ + min_W2_) - mean_square_W2_);
    const double weight = 1.0 / (size_W2 + mean_square_W2_ + min_W2_);
    cross_sum_ += weight * z * d - memory_smoothing_ * cross_sum_;
    square_sum_ += weight * d * d - memory_smoothing_ * square_sum_;
  }

  double value() const {
    return std::clamp(2.0 * (cross_sum_ + prior_weight_) / (square_sum_ + prior_weight_), 0.0, 1.0);
  }

 private:
  static constexpr double max_ratio = 10.0;

  double min_W2_;
  double trend_smoothing_;
  double memory_smoothing_;
  double prior_weight_;  ///< one second of observations, in favour
  double residual_trend_W_ = 0.0;
  double learned_trend_W_ = 0.0;
  double mean_square_W2_ = 0.0;
  double cross_sum_ = 0.0;   // weighted sum of z d
  double square_sum_ = 0.0;  // of d²
};

}  // namespace supercoil::control
