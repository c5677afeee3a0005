// The estimators of a muscle: one is at work, and tells what it knows.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "supercoil/control/actuator/parameters.hpp"
#include "supercoil/control/estimation/estimator.hpp"

#include "loop/snapshot.hpp"

namespace supercoil {

class Estimation {
 public:
  /// At least one estimator. Allocates; nothing after it does.
  Estimation(const std::vector<control::EstimatorSettings>& estimators, double step_s);

  std::size_t estimators() const { return estimators_.size(); }
  void choose(std::size_t place);
  /// The one at this place becomes another, which begins, and the other way round.
  void exchange(std::size_t place, control::Estimator& estimator);
  std::size_t chosen() const { return chosen_; }
  /// The muscle was not driven for a while.
  void restart() { estimators_[chosen_].restart(); }
  /// One tick: this tick's position, and the power applied since the last one.
  void step(double position_m, double applied_W) {
    estimators_[chosen_].step(position_m, applied_W);
  }

  /// As it is now; empty: this estimator tells nothing yet.
  const std::optional<control::Estimate>& estimate() const {
    return estimators_[chosen_].estimate();
  }
  bool trusted() const { return estimate() && estimate()->trusted; }
  /// Empty: no estimate is trusted, or it is no muscle's. What theta does not tell is as known.
  std::optional<control::PhysicalParameters> trusted_muscle(
      const control::PhysicalParameters& known) const;
  /// selector: of a full turn, chooses the value that is told beside theta.
  void publish(std::uint32_t selector, Snapshot& s) const;

 private:
  std::vector<control::Estimator> estimators_;
  std::size_t chosen_ = 0;
};

}  // namespace supercoil
