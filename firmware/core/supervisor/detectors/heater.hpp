// Does the heater do what is commanded, and nothing else?
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "supervisor/detectors/limits.hpp"

namespace supercoil::detectors {

/// Trips when duty is applied and the current stays below min_A for hold_s: a broken wire.
class OpenLoad final : public Detector {
 public:
  struct Settings {
    double min_duty;  ///< below it the current is too small to judge
    double min_A_per_duty;
    double hold_s;
  };
  OpenLoad(const Settings& settings, double step_s)
      : settings_(settings), held_(settings.hold_s, step_s) {}

  bool step(double duty, double current_A) {
    current_A_ = current_A;
    min_A_ = settings_.min_A_per_duty * duty;
    judged_ = duty >= settings_.min_duty;
    return held_.step(judged_ && !(current_A >= min_A_));
  }
  Margin margin() const override { return {current_A_, min_A_, true, judged_}; }

 private:
  Settings settings_;
  HoldTimer held_;
  double current_A_ = 0.0;
  double min_A_ = 0.0;
  bool judged_ = false;
};

/// Trips when the current in A is above its limit for hold_s, which is short; the switch's own
/// protection is faster still.
using Short = Above;

/// Trips when current still flows hold_s after the channel was made safe. Only current proves that
/// power is off: a duty that reads back as zero is the kernel's memory. An averaging sense still
/// shows earlier current, which must have decayed by the end of hold_s, not from the start.
class StuckOn final : public Detector {
 public:
  struct Settings {
    double max_A;           ///< what a cold channel may show: offset and noise
    double hold_s = 0.05;   ///< time allowed to fall to that
    double filter_s = 0.0;  ///< time constant of the sense, >= 0; 0: it does not average
  };
  StuckOn(const Settings& settings, double step_s)
      : settings_(settings),
        held_(settings.hold_s, step_s),
        decay_(settings.filter_s > 0.0 ? std::exp(-step_s / (filter_tolerance * settings.filter_s))
                                       : 0.0) {}

  /// off: the duty is 0 or the enable line low.
  bool step(bool off, double current_A) {
    if (!off && std::isfinite(current_A)) remaining_A_ = current_A;
    // The first reading may be from the tick before.
    if (off && !off_ && std::isfinite(current_A)) remaining_A_ = std::fmax(remaining_A_, current_A);
    if (off && off_) remaining_A_ *= decay_;
    current_A_ = current_A;
    off_ = off;
    const bool held = held_.step(off && !(current_A <= settings_.max_A));
    return held && !(current_A <= max_A());
  }
  Margin margin() const override { return {current_A_, max_A(), false, off_}; }

 private:
  static constexpr double filter_tolerance = 1.25;  ///< of the filter's resistor and capacitor

  double max_A() const { return settings_.max_A + (decay_ > 0.0 ? remaining_A_ : 0.0); }

  Settings settings_;
  HoldTimer held_;
  double decay_;  ///< of a tick; 0: the sense does not average
  double current_A_ = 0.0;
  double remaining_A_ = 0.0;  ///< earlier current that the sense may still show
  bool off_ = false;
};

/// How a calibration changed the positions measured at the same places.
struct Recalibration {
  double before_m = 0.0;  ///< a place before it
  double after_m = 0.0;   ///< the same place after it
  double ratio = 1.0;     ///< of distances, after over before

  /// Where a position from before is measured now.
  double after(double position_m) const { return after_m + ratio * (position_m - before_m); }
  /// Both in sequence, this one first.
  Recalibration then(const Recalibration& next) const {
    return {before_m, next.after(after_m), ratio * next.ratio};
  }
};

/// Power in, no motion: compares how far the muscle moved over a window with how far it must have
/// moved by the models of its heat. Trips when it moved less than min_ratio of the motion of every
/// muscle that they allow. "Rose 0.3 of the 2.0 mm expected in 20 s."
class NotResponding final : public Detector {
 public:
  struct Settings {
    double window_s = 20.0;
    double min_ratio = 0.3;         ///< of the expected motion
    double min_expected_m = 0.001;  ///< an expected motion smaller than this is not judged
  };
  NotResponding(const Settings& settings, double step_s) : settings_(settings), step_s_(step_s) {}

  /// Positions of the models, driven by the applied power: the believed muscle, and the fastest and
  /// the slowest that its thermal bounds allow.
  using Expected = std::array<double, 3>;

  /// Besides the believed muscle, eight steps from the fastest to the slowest: when one of those
  /// still rises and the other already falls, one in between stands still.
  static constexpr std::size_t steps = 8;
  /// Ratios of the other muscle's gain to its believed gain, with this muscle's as believed; 0: the
  /// other has no effect.
  static constexpr std::array gains{0.0, 0.1,  0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0,
                                    1.1, 1.25, 1.4, 1.6, 1.8, 2.1, 2.5, 3.0, 4.0, 6.0, 10.0};

  static constexpr std::size_t alone = steps + 2;  ///< motions of a muscle without another
  static constexpr std::size_t all = alone + gains.size();

  /// Possible positions of the muscle; the first `count` are valid.
  struct Motions {
    std::array<double, all> m;
    std::size_t count = alone;

    /// The minimum rise of any motion. Four rows side by side: a single one would wait for itself.
    double min_rise_above(const Motions& low) const {
      std::array<double, 4> min_rise{};
      min_rise.fill(m[0] - low.m[0]);
      std::size_t i = 0;
      for (; i + min_rise.size() <= count; i += min_rise.size()) {
        for (std::size_t row = 0; row < min_rise.size(); ++row)
          min_rise[row] = std::min(min_rise[row], m[i + row] - low.m[i + row]);
      }
      for (; i < count; ++i)
        min_rise[0] = std::min(min_rise[0], m[i] - low.m[i]);
      return std::min(std::min(min_rise[0], min_rise[1]), std::min(min_rise[2], min_rise[3]));
    }
  };

  /// opposed_m: how far the joint's other muscle moves it back; null: there is no other. Both
  /// believed gains may be wrong, and the joint may then rest where the believed muscles would move
  /// it. Rest is a fault only if no gain of the other muscle explains it.
  static Motions possible(const Expected& expected_m, const Expected* opposed_m = nullptr) {
    const Expected none{};
    const Expected& opposed = opposed_m != nullptr ? *opposed_m : none;
    const double fastest = expected_m[1] - opposed[1];
    const double slowest = expected_m[2] - opposed[2];
    Motions motions;  // only up to count; zeroing it first took a fifth of the judgement
    motions.m[0] = expected_m[0] - opposed[0];
    for (std::size_t i = 0; i <= steps; ++i)
      motions.m[i + 1] = fastest + static_cast<double>(i) / steps * (slowest - fastest);
    if (opposed_m == nullptr) return motions;
    for (std::size_t i = 0; i < gains.size(); ++i)
      motions.m[alone + i] = expected_m[0] - gains[i] * opposed[0];
    motions.count = all;
    return motions;
  }

  bool step(double position_m, const Motions& motions) {
    if (elapsed_s_ == 0.0 || range_restarts_) {
      low_ = high_ = position_m;
      expected_low_ = expected_high_ = motions;
      range_restarts_ = false;
    }
    elapsed_s_ += step_s_;
    low_ = std::min(low_, position_m);
    high_ = std::max(high_, position_m);
    // The models are thermal only: a muscle may still be on its way.
    if (elapsed_s_ <= in_time_ratio * settings_.window_s) {
      // A count that the compiler knows: two at once.
      if (motions.count == alone) {
        widen<alone>(motions);
      } else {
        widen<all>(motions);
      }
    }
    if (elapsed_s_ + 0.5 * step_s_ < settings_.window_s) return false;
    elapsed_s_ = 0.0;
    const Margin seen = margin();
    return seen.judged && !(seen.measured >= seen.limit);
  }
  void reset() { elapsed_s_ = 0.0; }
  /// The muscle was proven to live: earlier expectations and motions in this window no longer
  /// count. A muscle in a draught needs more power to stand still, which no model expects.
  void restart_range() { range_restarts_ = true; }
  /// Converts the positions so far. A new calibration is not motion, and it must not restart the
  /// window: repeated calibration would prevent any judgement.
  void recalibrate(const Recalibration& change) {
    low_ = change.after(low_);
    high_ = change.after(high_);
    if (low_ > high_) std::swap(low_, high_);
  }
  /// Of the window so far.
  Margin margin() const override {
    const double expected = expected_high_.min_rise_above(expected_low_);
    const bool judged = expected >= settings_.min_expected_m;
    return {high_ - low_, settings_.min_ratio * expected, true, judged};
  }

 private:
  static constexpr double in_time_ratio = 0.95;  ///< of the window

  template <std::size_t count>
  void widen(const Motions& motions) {
    for (std::size_t i = 0; i < count; ++i) {
      expected_low_.m[i] = std::min(expected_low_.m[i], motions.m[i]);
      expected_high_.m[i] = std::max(expected_high_.m[i], motions.m[i]);
    }
  }

  Settings settings_;
  double step_s_;
  double elapsed_s_ = 0.0;
  bool range_restarts_ = false;
  double low_ = 0.0;
  double high_ = 0.0;
  Motions expected_low_{};
  Motions expected_high_{};
};

/// Trips when the PWM reads back a step other than the one set for hold_s (a buffered one lags).
class WrongDuty final : public Detector {
 public:
  WrongDuty(double hold_s, double step_s) : held_(hold_s, step_s) {}

  /// read_back: negative when the device cannot be read back; it is then not judged.
  bool step(int set, int read_back) {
    set_ = set;
    read_back_ = read_back;
    return held_.step(wrong());
  }
  /// The difference in steps; any difference is beyond the limit.
  Margin margin() const override {
    return rising(wrong() ? std::abs(static_cast<double>(read_back_) - set_) : 0.0, 0.0);
  }

 private:
  bool wrong() const { return read_back_ >= 0 && read_back_ != set_; }

  HoldTimer held_;
  int set_ = 0;
  int read_back_ = -1;
};

}  // namespace supercoil::detectors
