// The share of what was learned that a law should use.
#pragma once

#include <algorithm>
#include <cmath>

namespace supercoil::control {

/// As much as would have predicted the power no worse than nothing learned. z is what the muscle as
/// believed leaves of the power, d what was learned some seconds before adds to it: of all shares s
/// in [0, 1], the largest with E(z − s d)² ≤ E z², which is 2 E[z d]/E[d²]. Of both only what is
/// quicker than trend_s counts, since the feedback's integral has the rest. No observation counts
/// for much more than a usual one: the first seconds after a muscle has changed would else judge
/// for minutes.
class LearnedShare {
 public:
  /// All > 0.
  struct Settings {
    double period_s;         ///< between steps
    double min_W;            ///< of a power that says anything
    double trend_s = 2.0;    ///< for a muscle with a thermal time constant of 1.95 s
    double memory_s = 60.0;  ///< the same
  };

  /// slowness: of the muscle.
  LearnedShare(const Settings& s, double slowness)
      : min_W2_(s.min_W * s.min_W),
        trend_share_(s.period_s / (s.trend_s * slowness)),
        memory_share_(s.period_s / (s.memory_s * slowness)),
        trusting_(1.0 / s.period_s) {}

  /// All of it, until there are data.
  void restart() { both_ = learned_ = 0.0; }

  /// One observation; judge: it says something of the muscle.
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
  double trusting_;  ///< observations of a second, in favour
  double left_trend_W_ = 0.0;
  double learned_trend_W_ = 0.0;
  double usual_W2_ = 0.0;
  double both_ = 0.0;     // weighted sum of z d
  double learned_ = 0.0;  // of d²
};

}  // namespace supercoil::control
