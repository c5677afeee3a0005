// What every detector has in common: how near it is to tripping, and for how long.
#pragma once

#include <algorithm>
#include <cmath>

namespace supercoil::detectors {

/// What was measured and what the limit is, both in the detector's own unit.
struct Margin {
  double measured = 0.0;
  double limit = 0.0;
  bool falls = false;  ///< the limit is a least value, not a greatest
  bool judged = true;  ///< there was something to judge

  /// How much of the limit is used; 1 or more is beyond it. A NaN uses more than all of it.
  double used() const {
    if (!judged) return 0.0;
    if (std::isnan(measured)) return INFINITY;
    if (!falls && measured <= 0.0) return 0.0;
    if (!falls) return limit > 0.0 ? measured / limit : INFINITY;
    return measured > 0.0 ? limit / measured : INFINITY;
  }
};

/// Of a value that may rise to a limit.
inline Margin rising(double measured, double limit) {
  return {measured, limit, false, true};
}
/// Of a value that may fall to a limit.
inline Margin falling(double measured, double limit) {
  return {measured, limit, true, true};
}

/// A step says whether it trips, and keeps what it judged. Of a channel's thirty margins a tick
/// publishes one: only what is asked for is worked out.
class Detector {
 public:
  /// As of its last step, also far from tripping.
  virtual Margin margin() const = 0;

 protected:
  Detector() = default;
  Detector(const Detector&) = default;
  Detector& operator=(const Detector&) = default;
  ~Detector() = default;
};

/// Tells whether something has held for a whole time.
class HoldTimer {
 public:
  /// hold_s: 0 means at once. forgets: how many times as fast it is forgotten as it was held; by
  /// default any gap ends it. With less than 1 something that comes and goes adds up.
  HoldTimer(double hold_s, double step_s, double forgets = 1e12)
      : hold_s_(hold_s), step_s_(step_s), forgets_s_(forgets * step_s) {}

  /// One tick. True from the tick on at which it has held for hold_s.
  bool step(bool holds) {
    if (!holds && held_s_ == 0.0) return false;
    held_s_ = holds ? held_s_ + step_s_ : std::max(0.0, held_s_ - forgets_s_);
    // Half a step of tolerance: sums of steps are not exact.
    return holds && held_s_ + 0.5 * step_s_ > hold_s_;
  }
  void reset() { held_s_ = 0.0; }
  double held_s() const { return held_s_; }

 private:
  double hold_s_;
  double step_s_;
  double forgets_s_;
  double held_s_ = 0.0;
};

}  // namespace supercoil::detectors
