// The estimators of one muscle; only the chosen one runs.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "supercoil/control/actuator/parameters.hpp"
#include "supercoil/control/estimation/estimator.hpp"

#include "loop/snapshot.hpp"

namespace supercoil {

/// All estimators of a muscle's configuration; the chosen one is fed and gives the estimate.
class Estimation {
 public:
  /// At least one estimator. Allocates; later calls do not.
  Estimation(const std::vector<control::EstimatorSettings>& estimators, double step_s);

  std::size_t estimators() const { return estimators_.size(); }
  /// By its place in the configuration, which must exist; it starts afresh.
  void choose(std::size_t place);
  /// Swaps the estimator at this place with another; if it is the chosen one, it restarts.
  void exchange(std::size_t place, control::Estimator& estimator);
  std::size_t chosen() const { return chosen_; }
  /// Call this after the muscle was not driven for a while.
  void restart() { estimators_[chosen_].restart(); }
  /// One tick: this tick's position, and the power applied since the last one.
  void step(double position_m, double applied_W) {
    estimators_[chosen_].step(position_m, applied_W);
  }

  /// The current estimate; empty: none yet.
  const std::optional<control::Estimate>& estimate() const {
    return estimators_[chosen_].estimate();
  }
  bool trusted() const { return estimate() && estimate()->trusted; }
  /// Empty: no trusted estimate, or theta is not physical. `known` supplies what theta leaves open.
  std::optional<control::PhysicalParameters> trusted_muscle(
      const control::PhysicalParameters& known) const;
  /// selector over 2³² chooses the value that is published beside theta.
  void publish(std::uint32_t selector, Snapshot& s) const;

 private:
  std::vector<control::Estimator> estimators_;
  std::size_t chosen_ = 0;
};

}  // namespace supercoil
