// The power that a board's limiter leaves to a muscle over time, as it must believe it to be hot.
#pragma once

#include "supercoil/control/thermal/rise_interval_observer.hpp"

#include "loop/settings.hpp"

namespace supercoil::host_sim {

/// Of a board's first channel, from when a scenario begins.
class PowerLeft {
 public:
  struct Most {
    double power_W = 0.0;
    LimitedBy by = LimitedBy::nothing;
  };

  /// supply_V: that it has.
  PowerLeft(const BoardSettings& board, double supply_V, double step_s);

  Most now() const { return at(warmest_C_ + hot_.max_K()); }
  /// Of a cold muscle.
  Most cold() const { return at(warmest_C_); }
  /// That power is given for a step.
  void step(double power_W) { hot_.step(0.0, max_power_ratio_ * power_W); }

 private:
  Most at(double hottest_C) const;

  Limiter limiter_;
  double provable_W_;  ///< infinite: nothing is to be proven yet
  double warmest_C_;
  double max_power_ratio_;
  control::RiseIntervalObserver hot_;
};

}  // namespace supercoil::host_sim
