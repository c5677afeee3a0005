// Is the position sensor telling the truth?
#pragma once

#include "supervisor/detectors/limits.hpp"

namespace supercoil::detectors {

/// Trips when readings are outside [low, high], or are NaN, for hold_s (Klipper counts
/// consecutive faults for the same reason: one wild conversion is not a fault).
class OutOfRange final : public Detector {
 public:
  struct Settings {
    double low;
    double high;
    double hold_s;
  };
  /// A loose wire is intermittent: good readings count down only a quarter as fast.
  OutOfRange(const Settings& settings, double step_s)
      : settings_(settings), held_(settings.hold_s, step_s, 0.25) {}

  bool step(double reading) {
    reading_ = reading;
    return held_.step(!(reading >= settings_.low && reading <= settings_.high));
  }
  Margin margin() const override {
    const double middle = 0.5 * (settings_.low + settings_.high);
    return rising(std::abs(reading_ - middle), settings_.high - middle);
  }

 private:
  Settings settings_;
  HoldTimer held_;
  double reading_ = 0.0;
};

/// Trips when, while hot, readings stay within a band narrower than the sensor's own noise for
/// window_s. A live sensor shows its noise; one whose cable broke, or whose driver repeats its last
/// value, does not.
class Frozen final : public Detector {
 public:
  struct Settings {
    double band;  ///< readings of a live sensor spread over more than this; > 0
    double window_s;
  };
  Frozen(const Settings& settings, double step_s)
      : band_(settings.band), still_(settings.window_s, step_s) {}

  bool step(double reading, bool hot) {
    const bool outside = !(std::abs(reading - anchor_) <= band_);
    if (outside) anchor_ = reading;
    return still_.step(hot && !outside);
  }
  Margin margin() const override { return still_.margin(); }

 private:
  double band_;
  TimedFlag still_;
  double anchor_ = INFINITY;
};

/// Trips when two fresh readings in a row differ from the last good one by more than a muscle can
/// move between readings: a single one can be a glitch, and coming back from it is no jump.
class Jump final : public Detector {
 public:
  struct Settings {
    double speed;  ///< fastest credible motion, unit/s
    double noise;  ///< what two readings may differ by at rest
  };
  explicit Jump(const Settings& settings) : settings_(settings) {}

  /// elapsed_s: between the last fresh reading and this one.
  bool step(double reading, double elapsed_s) {
    allowed_ = settings_.speed * elapsed_s + settings_.noise;
    change_ = started_ ? std::abs(reading - last_) : 0.0;
    started_ = true;
    const bool jumped = !(change_ <= allowed_);
    // A reading without a jump takes back only a quarter: a bad contact is intermittent.
    count_ = jumped ? count_ + 1.0 : std::max(0.0, count_ - 0.25);
    if (!jumped || count_ >= 2.0) last_ = reading;
    return jumped && count_ >= 2.0;
  }
  Margin margin() const override { return rising(change_, allowed_); }

 private:
  Settings settings_;
  bool started_ = false;
  double last_ = 0.0;
  double count_ = 0.0;
  double change_ = 0.0;
  double allowed_ = 0.0;
};

/// Trips when the temperatures from resistance and from position differ by more than both can be
/// wrong, for hold_s.
class SensorsDisagree final : public Detector {
 public:
  /// limit: in K.
  SensorsDisagree(const Above::Settings& settings, double step_s) : difference_(settings, step_s) {}

  bool step(double from_resistance_K, double from_position_K) {
    return difference_.step(std::abs(from_resistance_K - from_position_K));
  }
  Margin margin() const override { return difference_.margin(); }

 private:
  Above difference_;
};

}  // namespace supercoil::detectors
