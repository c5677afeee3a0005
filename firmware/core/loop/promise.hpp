// A first motion to show that a muscle follows, and how closely it will.
#pragma once

#include "loop/feasibility.hpp"
#include "loop/known_muscle.hpp"
#include "loop/settings.hpp"

namespace supercoil {

/// A sine below the middle of the travel that the muscle can hold, a fifth slower than the fastest
/// that it can follow over half of it.
struct FirstMotion {
  double middle_m = 0.0;
  double amplitude_m = 0.0;
  double period_s = 0.0;

  /// The reference in m, time_s after the start; it begins at the lowest point.
  double at(double time_s) const;
  /// When the muscle is up and its controller knows the motion; one period is judged from here.
  double settled_s() const { return 2.0 * period_s; }
  double end_s() const { return settled_s() + period_s; }
};
/// unexplained_ratio: of the model that identify found; 0: not known.
FirstMotion plan_first_motion(const Feasibility& feasibility, double unexplained_ratio);

/// Rms tracking error of that motion as the board's sensor shows it, by cause.
struct Promise {
  double noise_m = 0.0;   ///< the sensor's own noise and counts, and what feedback makes of them
  double probe_m = 0.0;   ///< pulses that measure the resistance at low power
  double dither_m = 0.0;  ///< dither that proves the response where the motion is too small
  double pwm_m = 0.0;     ///< rounding of the power to PWM steps
  double delay_m = 0.0;   ///< power that acts later than the motion needs it
  double unexplained_m = 0.0;  ///< motion that the linear model does not explain

  double error_m() const;
};
/// Rms noise of a channel's sensor, including its counts.
double reading_noise_m(const ChannelSettings& channel);

/// Tested for learned_ff on random muscles (docs/setup.md), and for no other law; nor for a loop
/// with so little margin that it rings.
bool is_promised_for(const control::ControllerSettings& controller, const ChannelSettings& channel,
                     double step_s);
/// channel: includes what identify found.
Promise promise_error(const control::LearnedFeedforwardSettings& law,
                      const ChannelSettings& channel, const BoardSettings& board,
                      const FirstMotion& motion);

/// The channel with the muscle that the board uses now, instead of its file's.
ChannelSettings with_known(ChannelSettings channel, const KnownMuscle& known);

}  // namespace supercoil
