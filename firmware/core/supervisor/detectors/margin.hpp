// What every detector has in common: how near it is to tripping, and for how long.
#pragma once

#include <algorithm>
#include <cmath>

namespace supercoil::detectors {

/// What was measured and what the limit is, both in the detector's own unit.
struct Margin {
  double measured = 0.0;
  double limit = 0.0;
  bool falls = false;  ///< the limit is a minimum, not a maximum
  bool judged = true;  ///< there was something to judge

  /// How much of the limit is used; 1 or more is beyond it. Infinite for NaN.
  double used() const {
    if (!judged) return 0.0;
    if (std::isnan(measured)) return INFINITY;
    if (!falls && measured <= 0.0) return 0.0;
    if (!falls) return limit > 0.0 ? measured / limit : INFINITY;
    return measured > 0.0 ? limit / measured : INFINITY;
  }
};

/// For a value that may rise to a limit.
inline Margin rising(double measured, double limit) {
  return {measured, limit, false, true};
}
/// For a value that may fall to a limit.
inline Margin falling(double measured, double limit) {
  return {measured, limit, true, true};
}

/// A step returns whether it trips, and keeps what it judged. A tick publishes one of a channel's
/// thirty margins, so a margin is computed only on request.
class Detector {
 public:
  /// As of its last step, even far from tripping.
  virtual Margin margin() const = 0;

 protected:
  Detector() = default;
  Detector(const Detector&) = default;
  Detector& operator=(const Detector&) = default;
  ~Detector() = default;
};

/// Tells whether a condition has held for a given time.
class HoldTimer {
 public:
  /// hold_s: 0 means at once. recovery_ratio: how fast the held time decays during a gap, relative
  /// to its build-up; by default any gap ends it. Below 1, an intermittent condition adds up.
  HoldTimer(double hold_s, double step_s, double recovery_ratio = 1e12)
      : hold_s_(hold_s), step_s_(step_s), recovery_s_(recovery_ratio * step_s) {}

  /// One tick. True from the tick at which it has held for hold_s.
  bool step(bool holds) {
    if (!holds && held_s_ == 0.0) return false;
    held_s_ = holds ? held_s_ + step_s_ : std::max(0.0, held_s_ - recovery_s_);
    // Half a step of tolerance: sums of steps are not exact.
    return holds && held_s_ + 0.5 * step_s_ > hold_s_;
  }
  void reset() { held_s_ = 0.0; }
  double held_s() const { return held_s_; }

 private:
  double hold_s_;
  double step_s_;
  double recovery_s_;
  double held_s_ = 0.0;
};

}  // namespace supercoil::detectors
