// Limits: those that trip at once, and those that must be passed for a while.
#pragma once

#include "supervisor/detectors/margin.hpp"

namespace supercoil::detectors {

/// Trips at once when a value that must not be passed is passed, or is no number. For temperature:
/// the hottest of the observers; for travel: the position.
class Limit {
 public:
  explicit Limit(double limit) : limit_(limit) {}

  bool step(double value) {
    margin_ = rising(value, limit_);
    return !(value <= limit_);
  }
  const Margin& margin() const { return margin_; }

 private:
  double limit_;
  Margin margin_;
};

/// Trips when a value is above its limit, or is no number, for hold_s.
class Above {
 public:
  struct Settings {
    double limit;
    double hold_s;
  };
  Above(const Settings& settings, double step_s)
      : settings_(settings), held_(settings.hold_s, step_s) {}

  bool step(double value) {
    margin_ = rising(value, settings_.limit);
    return held_.step(!(value <= settings_.limit));
  }
  const Margin& margin() const { return margin_; }

 private:
  Settings settings_;
  HeldFor held_;
  Margin margin_;
};

/// Trips when a value is below its limit, or is no number, for hold_s.
class Below {
 public:
  struct Settings {
    double limit;
    double hold_s;
  };
  Below(const Settings& settings, double step_s)
      : settings_(settings), held_(settings.hold_s, step_s) {}

  bool step(double value) {
    margin_ = falling(value, settings_.limit);
    return held_.step(!(value >= settings_.limit));
  }
  const Margin& margin() const { return margin_; }

 private:
  Settings settings_;
  HeldFor held_;
  Margin margin_;
};

}  // namespace supercoil::detectors
