// Is the position sensor telling the truth?
#pragma once

#include "supervisor/detectors/limits.hpp"

namespace supercoil::detectors {

/// Trips when readings are outside [low, high], or are no numbers, for hold_s (Klipper counts
/// consecutive faults for the same reason: one wild conversion is no fault).
class OutOfRange {
 public:
  struct Settings {
    double low;
    double high;
    double hold_s;
  };
  /// A loose wire comes and goes: good readings take back only a quarter.
  OutOfRange(const Settings& settings, double step_s)
      : settings_(settings), held_(settings.hold_s, step_s, 0.25) {}

  bool step(double reading) {
    const double middle = 0.5 * (settings_.low + settings_.high);
    margin_ = rising(std::abs(reading - middle), settings_.high - middle);
    return held_.step(!(reading >= settings_.low && reading <= settings_.high));
  }
  const Margin& margin() const { return margin_; }

 private:
  Settings settings_;
  HeldFor held_;
  Margin margin_;
};

/// Trips when the newest reading is older than its limit in seconds.
using Stale = Limit;

/// Trips when, while hot, readings stay within a band narrower than the sensor's own noise for
/// window_s. A live sensor shows its noise; one whose cable broke, or whose driver repeats its last
/// value, does not.
class Frozen {
 public:
  struct Settings {
    double band;  ///< readings of a live sensor spread over more than this; > 0
    double window_s;
  };
  Frozen(const Settings& settings, double step_s)
      : settings_(settings), held_(settings.window_s, step_s) {}

  bool step(double reading, bool hot) {
    const bool outside = !(std::abs(reading - anchor_) <= settings_.band);
    if (outside) anchor_ = reading;
    const bool trips = held_.step(hot && !outside);
    margin_ = rising(held_.held_s(), settings_.window_s);
    return trips;
  }
  const Margin& margin() const { return margin_; }

 private:
  Settings settings_;
  HeldFor held_;
  double anchor_ = INFINITY;
  Margin margin_;
};

/// Trips when fresh readings differ by more than a muscle can move between them, twice running: one
/// jump can be a glitch, and coming back from it is a jump as well.
class Jump {
 public:
  struct Settings {
    double speed;  ///< fastest credible motion, unit/s
    double noise;  ///< what two readings may differ by at rest
  };
  explicit Jump(const Settings& settings) : settings_(settings) {}

  /// elapsed_s: between the last fresh reading and this one.
  bool step(double reading, double elapsed_s) {
    const double allowed = settings_.speed * elapsed_s + settings_.noise;
    const double change = started_ ? std::abs(reading - last_) : 0.0;
    started_ = true;
    margin_ = rising(change, allowed);
    const bool jumped = !(change <= allowed);
    // A reading that is where it was takes back only a quarter: a bad contact comes and goes.
    count_ = jumped ? count_ + 1.0 : std::max(0.0, count_ - 0.25);
    if (!jumped || count_ >= 2.0) last_ = reading;
    return jumped && count_ >= 2.0;
  }
  const Margin& margin() const { return margin_; }

 private:
  Settings settings_;
  bool started_ = false;
  double last_ = 0.0;
  double count_ = 0.0;
  Margin margin_;
};

/// Trips when the temperature that resistance tells and the one that position tells lie further
/// apart than both can be wrong, for hold_s.
class Disagree {
 public:
  /// limit: in K.
  Disagree(const Above::Settings& settings, double step_s) : difference_(settings, step_s) {}

  bool step(double from_resistance_K, double from_position_K) {
    return difference_.step(std::abs(from_resistance_K - from_position_K));
  }
  const Margin& margin() const { return difference_.margin(); }

 private:
  Above difference_;
};

}  // namespace supercoil::detectors
