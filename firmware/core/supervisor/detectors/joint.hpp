// Does each muscle of a joint still move it?
#pragma once

#include "supervisor/detectors/heater.hpp"
#include "supervisor/detectors/margin.hpp"

namespace supercoil::detectors {

/// A muscle of a joint gets hotter, is asked for more than it can give, and the joint stays where
/// it is: the muscle is torn, or its cable slack. In seconds, where NotResponding takes a window:
/// it must not take a muscle that holds a growing load still for a dead one, and no load is held
/// still by a muscle that has no more to give.
class MuscleLoose final : public Detector {
 public:
  struct Settings {
    double min_ratio;       ///< of the expected motion
    double min_expected_m;  ///< an expected motion smaller than this is not judged
    double hold_s = 0.5;    ///< the models have heat only: the joint may still be on its way
  };
  MuscleLoose(const Settings& settings, double step_s)
      : moved_m_(settings.min_ratio * settings.min_expected_m),
        motion_({longest_s, settings.min_ratio, settings.min_expected_m}, step_s),
        held_(settings.hold_s, step_s) {}

  /// limited: the muscle gets less than is asked of it. Positions as NotResponding's: each time
  /// that the joint has moved, what is expected counts anew.
  bool step(bool limited, double position_m, const NotResponding::Expected& expected_m,
            const NotResponding::Expected& opposed_m) {
    if (!limited) {
      motion_.reset();
      margin_ = {0.0, 0.0, true, false};
      return held_.step(false);
    }
    motion_.step(position_m, expected_m, &opposed_m);
    margin_ = motion_.margin();
    if (margin_.measured >= moved_m_) motion_.reset();
    return held_.step(margin_.judged && !(margin_.measured >= margin_.limit));
  }
  /// Every position moved.
  void reset() { motion_.reset(); }
  Margin margin() const override { return margin_; }

 private:
  static constexpr double longest_s = 20.0;  ///< what is expected more slowly is not judged

  double moved_m_;
  NotResponding motion_;
  HoldTimer held_;
  Margin margin_{0.0, 0.0, true, false};
};

}  // namespace supercoil::detectors
