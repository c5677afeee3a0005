// What every detector has in common: how near it is to tripping, and for how long.
#pragma once

#include <cmath>

namespace supercoil::detectors {

/// Published every tick, also when all is well: how much of the limit is used, what was measured
/// and what the limit is, both in the detector's own unit. used ≥ 1 is beyond the limit.
struct Margin {
  double used = 0.0;
  double measured = 0.0;
  double limit = 0.0;
};

/// Of a value that may rise to a limit. A NaN uses more than all of it.
inline Margin rising(double measured, double limit) {
  return {std::isnan(measured) ? INFINITY : measured / limit, measured, limit};
}

/// Tells whether something has held for a whole time without a gap.
class HeldFor {
 public:
  /// hold_s: 0 means at once.
  HeldFor(double hold_s, double step_s) : hold_s_(hold_s), step_s_(step_s) {}

  /// One tick. True from the tick on at which it has held for hold_s.
  bool step(bool holds) {
    held_s_ = holds ? held_s_ + step_s_ : 0.0;
    // Half a step of tolerance: sums of steps are not exact.
    return holds && held_s_ + 0.5 * step_s_ > hold_s_;
  }
  void reset() { held_s_ = 0.0; }
  double held_s() const { return held_s_; }

 private:
  double hold_s_;
  double step_s_;
  double held_s_ = 0.0;
};

}  // namespace supercoil::detectors
