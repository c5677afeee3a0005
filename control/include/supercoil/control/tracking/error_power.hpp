// The power that corresponds to a muscle's distance from its reference model's motion.
#pragma once

#include <utility>

#include "supercoil/control/actuator/parameters.hpp"

namespace supercoil::control {

/// P = f(xm − e) is about f(xm) − (θ4 e + θ3 ė + θ2 ë): a regression of the applied power on the
/// model's motion must add the error's power, or it learns the feedback's work as the muscle's. A
/// slow feedback, as on a lightly damped muscle, leaves errors for seconds; a limited power leaves
/// them for as long as it lasts. The error goes through the regression's own two low-passes, after
/// which its derivatives are not noise.
class ErrorPower {
 public:
  void restart() { *this = {}; }

  /// One tick. error: the model's position less the muscle's, in watts at rest. The previous error
  /// belongs to the power that acted since.
  void step(double error) { sum_ += std::exchange(last_, error); }

  /// Ends a period of this many ticks. smoothing: of a low-pass, in a period.
  void update(double ticks, double smoothing, double period_s) {
    once_ += smoothing * (std::exchange(sum_, 0.0) / ticks - once_);
    const double before = twice_;
    twice_ += smoothing * (once_ - twice_);
    const double rate = (twice_ - before) / period_s;
    rate_change_ = (rate - rate_) / period_s;
    rate_ = rate;
  }

  /// units: θ in watts at rest, as MotionRegressors has it.
  double power_W(const Theta& units) const {
    return units[3] * twice_ + units[2] * rate_ + units[1] * rate_change_;
  }

 private:
  double last_ = 0.0;
  double sum_ = 0.0;
  double once_ = 0.0;
  double twice_ = 0.0;
  double rate_ = 0.0;
  double rate_change_ = 0.0;
};

}  // namespace supercoil::control
