#include "supercoil/control/estimation/estimate_drift.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace supercoil::control {

EstimateDrift::EstimateDrift(const Settings& s)
    : settings_(s),
      steps_per_slot_(std::max<std::int64_t>(
          1, std::llround(s.lag_s / s.update_s / static_cast<double>(slots)))) {}

void EstimateDrift::step(const Parameters& theta, const Square& covariance) {
  if (++steps_ < steps_per_slot_) return;
  steps_ = 0;
  Past& past = past_[slot_];
  slot_ = (slot_ + 1) % slots;
  if (past.known) {
    const Parameters moved = theta - past.theta;
    const double square = moved.dot(past.information * moved) / past.directions;
    const double slot_s = settings_.update_s * static_cast<double>(steps_per_slot_);
    comparisons_ = std::min(comparisons_ + 1.0, settings_.memory_s / slot_s);
    mean_square_ += (square - mean_square_) / comparisons_;
  }
  // In a direction in which nothing is known, the variance is the prior's.
  const double unknown = covariance.diagonal().cwiseQuotient(settings_.unexcited).sum();
  past = {.known = true,
          .theta = theta,
          .information = covariance.inverse(),
          .directions = std::max(1.0, static_cast<double>(size) - unknown)};
}

void EstimateDrift::forget_past() {
  for (Past& past : past_)
    past.known = false;
}

}  // namespace supercoil::control
