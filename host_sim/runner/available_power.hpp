// The power that a board's limiter leaves to a muscle over time, given how hot it may be.
#pragma once

#include "supercoil/control/thermal/interval_observer.hpp"

#include "loop/settings.hpp"

namespace supercoil::host_sim {

/// For a board's first channel, from the beginning of a scenario.
class AvailablePower {
 public:
  struct Limit {
    double power_W = 0.0;
    LimitedBy by = LimitedBy::nothing;
  };

  /// supply_V: the board's supply.
  AvailablePower(const BoardSettings& board, double supply_V, double step_s);

  Limit now() const { return at(warmest_C_ + hottest_K_); }
  /// For a cold muscle.
  Limit cold() const { return at(warmest_C_); }
  /// Applies this power for a step.
  void step(double power_W) { hottest_K_ = hot_.next_K(hottest_K_, max_power_ratio_ * power_W); }

 private:
  Limit at(double hottest_C) const;

  Limiter limiter_;
  double provable_W_;  ///< infinite: nothing has to be proven
  double warmest_C_;
  double max_power_ratio_;
  control::BasicIntervalEnd<double> hot_;  ///< of the board's interval
  double hottest_K_;
};

}  // namespace supercoil::host_sim
