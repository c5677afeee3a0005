// Limits that trip at once, and limits that must be exceeded for a while.
#pragma once

#include "supervisor/detectors/margin.hpp"

namespace supercoil::detectors {

/// Trips at once when a value exceeds its limit, or is NaN. For temperature: the hottest of the
/// observers; for travel: the position.
class Limit final : public Detector {
 public:
  explicit Limit(double limit) : limit_(limit) {}

  bool step(double value) {
    value_ = value;
    return !(value <= limit_);
  }
  Margin margin() const override { return rising(value_, limit_); }

 private:
  double limit_;
  double value_ = 0.0;
};

/// Trips at once when a yes-or-no condition is bad.
class Flag final : public Detector {
 public:
  /// which: the way in which it is bad, from 1.
  bool step(bool bad, int which = 1) {
    measured_ = bad ? which : 0;
    return bad;
  }
  /// 0: good, else in which way it is bad.
  Margin margin() const override { return rising(measured_, 0.0); }

 private:
  int measured_ = 0;
};

/// Trips when a value is above its limit, or is NaN, for hold_s.
class Above final : public Detector {
 public:
  struct Settings {
    double limit;
    double hold_s;
  };
  Above(const Settings& settings, double step_s)
      : settings_(settings), held_(settings.hold_s, step_s) {}

  bool step(double value) {
    value_ = value;
    return held_.step(!(value <= settings_.limit));
  }
  Margin margin() const override { return rising(value_, settings_.limit); }

 private:
  Settings settings_;
  HoldTimer held_;
  double value_ = 0.0;
};

/// Trips when a value is below its limit, or is NaN, for hold_s.
class Below final : public Detector {
 public:
  struct Settings {
    double limit;
    double hold_s;
  };
  Below(const Settings& settings, double step_s)
      : settings_(settings), held_(settings.hold_s, step_s) {}

  bool step(double value) {
    value_ = value;
    return held_.step(!(value >= settings_.limit));
  }
  Margin margin() const override { return falling(value_, settings_.limit); }

 private:
  Settings settings_;
  HoldTimer held_;
  double value_ = 0.0;
};

/// Trips when a bad state has lasted for max_s; 0: at once.
class TimedFlag final : public Detector {
 public:
  TimedFlag(double max_s, double step_s) : max_s_(max_s), held_(max_s, step_s) {}

  bool step(bool holds) { return held_.step(holds); }
  void reset() { held_.reset(); }
  Margin margin() const override { return rising(held_.held_s(), max_s_); }

 private:
  double max_s_;
  HoldTimer held_;
};

}  // namespace supercoil::detectors
