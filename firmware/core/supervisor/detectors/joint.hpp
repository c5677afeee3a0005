// Does each muscle of a joint still move it?
#pragma once

#include <algorithm>
#include <cstddef>

#include "supervisor/detectors/heater.hpp"
#include "supervisor/detectors/margin.hpp"

namespace supercoil::detectors {

/// Trips when a muscle gets hotter and the joint moves the other way, three times in a row, by at
/// least min_ratio of what every model of the muscles expects. Once may be a new load.
class MovesAway {
 public:
  /// min_expected_m: for all times together.
  MovesAway(double min_ratio, double min_expected_m)
      : min_ratio_(min_ratio), expected_each_m_(min_expected_m / times) {}

  bool step(double position_m, const NotResponding::Motions& motions_m) {
    if (begins_) {
      begins_ = false;
      from_m_ = position_m;
      expected_from_m_ = motions_m;
    }
    const double expected_m = motions_m.min_rise_above(expected_from_m_);
    if (expected_m >= expected_each_m_) {
      begins_ = true;
      margin_ = {from_m_ - position_m, min_ratio_ * expected_m, false, true};
      count_ = margin_.measured >= margin_.limit ? count_ + 1 : 0;
    }
    return count_ >= times;
  }
  void reset() {
    begins_ = true;
    count_ = 0;
  }
  /// How far the joint moved the other way the last time.
  Margin margin() const { return margin_; }

 private:
  static constexpr int times = 3;

  double min_ratio_;
  double expected_each_m_;
  bool begins_ = true;
  int count_ = 0;
  double from_m_ = 0.0;
  NotResponding::Motions expected_from_m_{};
  Margin margin_{0.0, 0.0, false, false};
};

/// Trips when a muscle of a joint gets hotter, more is demanded than it can give, and the joint
/// stays put or moves the other way: the muscle is torn, its cable is slack, or its heater or the
/// sensor's sign is the other muscle's. It takes seconds; NotResponding takes a whole window, as it
/// must not mistake a muscle that holds a growing load for a dead one. A muscle at its limit cannot
/// do that.
class MuscleLoose final : public Detector {
 public:
  struct Settings {
    double min_ratio;       ///< of the expected motion
    double min_expected_m;  ///< an expected motion smaller than this is not judged
    double hold_s = 0.5;    ///< the models are thermal only: the joint may still be on its way
  };
  MuscleLoose(const Settings& settings, double step_s)
      : moved_m_(settings.min_ratio * settings.min_expected_m),
        motion_({longest_s, settings.min_ratio, settings.min_expected_m}, step_s),
        away_(settings.min_ratio, settings.min_expected_m),
        held_(settings.hold_s, step_s) {}

  /// limited: the muscle gets less than is demanded. Positions as NotResponding's; the expected
  /// motion is counted from zero each time the joint has moved.
  bool step(bool limited, double position_m, const NotResponding::Motions& motions) {
    if (!limited) {
      reset();
      margin_ = {0.0, 0.0, true, false};
      return held_.step(false);
    }
    motion_.step(position_m, motions);
    margin_ = motion_.margin();
    if (margin_.measured >= moved_m_) motion_.reset();
    const bool away = away_.step(position_m, motions);
    if (away) margin_ = away_.margin();
    return away || held_.step(margin_.judged && !(margin_.measured >= margin_.limit));
  }
  /// Every position moved.
  void reset() {
    motion_.reset();
    away_.reset();
  }
  Margin margin() const override { return margin_; }

 private:
  static constexpr double longest_s = 20.0;  ///< slower expected motion is not judged

  double moved_m_;
  NotResponding motion_;
  MovesAway away_;
  HoldTimer held_;
  Margin margin_{0.0, 0.0, true, false};
};

}  // namespace supercoil::detectors
