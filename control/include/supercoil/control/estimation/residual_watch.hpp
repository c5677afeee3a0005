// Notices at once that a regression no longer holds.
#pragma once

#include <algorithm>
#include <cmath>

namespace supercoil::control {

/// Compares the residuals of the last moments with their usual mean square. Standard deviations
/// that follow from the latter grow only within seconds of a change.
class ResidualWatch {
 public:
  /// update_s: > 0, between regressions.
  explicit ResidualWatch(double update_s) : update_s_(update_s) {}

  /// One regression: its residual, and the usual mean square in W².
  void step(double residual_W, double usual_W2) {
    const double square_W2 = residual_W * residual_W;
    recent_W2_ += (square_W2 - recent_W2_) * std::min(1.0, update_s_ / recent_s);
    usual_s_ += update_s_;
    if (recent_W2_ > max_ratio * usual_W2) usual_s_ = 0.0;
  }
  /// For how long the residuals have been as usual; infinity if they always were.
  double usual_s() const { return usual_s_; }

 private:
  static constexpr double recent_s = 0.3;
  static constexpr double max_ratio = 25.0;

  double update_s_;
  double recent_W2_ = 0.0;
  double usual_s_ = INFINITY;
};

}  // namespace supercoil::control
