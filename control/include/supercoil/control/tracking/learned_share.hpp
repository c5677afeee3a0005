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
        trend_share_(s.period_s / (s.trend_s * slowness)),
        memory_share_(s.period_s / (s.memory_s * slowness)),
        trusting_(1.0 / s.period_s) {}

  /// Uses all of it, until there are data.
  void restart() { both_ = learned_ = 0.0; }

  /// One observation. judge: it says something about the muscle.
  void step(double left_W, double learned_W, bool judge) {
    left_trend_W_ += trend_share_ * (left_W - left_trend_W_);
    learned_trend_W_ += trend_share_ * (learned_W - learned_trend_W_);
    if (!judge) return;
    const double z = left_W - left_trend_W_;
    const double d = learned_W - learned_trend_W_;
    const double size_W2 = z * z + d * d;
    usual_W2_ += memory_share_ * (std::min(size_W2, max_ratio * usual_W2_ + min_W2_) - usual_W2_);
    const double weight = 1.0 / (size_W2 + usual_W2_ + min_W2_);
    both_ += weight * z * d - memory_share_ * both_;
    learned_ += weight * d * d - memory_share_ * learned_;
  }

  double value() const {
    return std::clamp(2.0 * (both_ + trusting_) / (learned_ + trusting_), 0.0, 1.0);
  }

 private:
  static constexpr double max_ratio = 10.0;

  double min_W2_;
  double trend_share_;
  double memory_share_;
  double trusting_;  ///< one second of observations, in favour
  double left_trend_W_ = 0.0;
  double learned_trend_W_ = 0.0;
  double usual_W2_ = 0.0;
  double both_ = 0.0;     // weighted sum of z d
  double learned_ = 0.0;  // of d²
};

}  // namespace supercoil::control
