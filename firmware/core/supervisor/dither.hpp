// A small, short change of power whose response stands out from the sensor's noise.
#pragma once

#include <cmath>

#include "supercoil/control/actuator/parameters.hpp"
#include "supercoil/control/linear/discretize.hpp"

#include "supervisor/detectors/response.hpp"

namespace supercoil {

/// For any motion. Slower motion counts less, as it may be drift. With a higher corner, a sine of
/// 0.25 rad/s and 18 mm would at times prove nothing for longer than a dither waits.
inline constexpr double motion_corner_rad_per_s = 1.0;
/// For a dither's answer: a load or a draught moves the muscle further than the dither, but slower.
inline constexpr double dither_corner_rad_per_s = 4.0;

/// Position of a muscle's model, in steps of some 10 ms.
class ExpectedMotion {
 public:
  /// response_ratio: how much of the motion arrives at the sensor.
  ExpectedMotion(const control::PhysicalParameters& muscle, double step_s,
                 double response_ratio = 1.0);

  /// power_W: during this step. Returns the mean position in this step.
  double step(double power_W) {
    const double before_m = state_[1];
    state_ = discrete_.transition * state_ + discrete_.held.col(0) * power_W;
    return 0.5 * response_ratio_ * (before_m + state_[1]);
  }
  double response_ratio() const { return response_ratio_; }
  /// Continues from the state of another model of the same muscle.
  void take_over(const ExpectedMotion& other) { state_ = other.state_; }

 private:
  control::ZeroOrderHold<3, 2> discrete_;
  double response_ratio_;
  control::Vector<double, 3> state_ = control::Vector<double, 3>::Zero();
};

/// Error of a sensor's mean over a step.
struct SensorStep {
  double noise_m;  ///< standard deviation of a step's mean
  double count_m;  ///< one count of the converter
};

/// A square wave around the demanded power that begins in the middle of a half: its answer is
/// centred on the position, and whole periods leave no offset behind.
struct Dither {
  int half_steps = 1;
  double amplitude_W = 0.0;
  /// Corner of the high-passes for its answer.
  double corner_rad_per_s = dither_corner_rad_per_s;
  /// Time until its answer in open loop is needed_deviations of the noise; infinite: never.
  double decided_s = INFINITY;

  /// place: steps since it began. +1 or -1.
  double sign(int place) const {
    return (place + half_steps / 2) / half_steps % 2 == 0 ? 1.0 : -1.0;
  }
  /// Power to add at this place; see sign().
  double step_W(int place) const { return sign(place) * amplitude_W; }
};

/// The slowest, so gentlest, dither that is decided within in_time_s on a muscle with this motion,
/// with an answer of at most 20 µm or two counts. If none is in time, the one decided soonest.
Dither dither_for(const ExpectedMotion& motion, const SensorStep& sensor, double max_W,
                  double in_time_s, double step_s);

}  // namespace supercoil
