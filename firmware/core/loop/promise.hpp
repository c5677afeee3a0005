// Which motion shows that a muscle follows, and how closely it will.
#pragma once

#include "loop/feasibility.hpp"
#include "loop/known_muscle.hpp"
#include "loop/settings.hpp"

namespace supercoil {

/// A sine below the middle of what the muscle can hold, a fifth slower than the fastest that it can
/// follow over half of it.
struct FirstMotion {
  double middle_m = 0.0;
  double amplitude_m = 0.0;
  double period_s = 0.0;

  double at(double time_s) const;
  /// Until it has come up from rest and its controller knows the motion; then one period is judged.
  double settled_s() const { return 2.0 * period_s; }
  double end_s() const { return settled_s() + period_s; }
};
/// unexplained_ratio: by the model that identify found; 0: not known.
FirstMotion plan_first_motion(const Feasibility& feasibility, double unexplained_ratio);

/// Tracking error of that motion, rms, as the board's sensor shows it, from what causes it.
struct Promise {
  double noise_m = 0.0;   ///< the sensor's own noise and counts, and what feedback makes of them
  double probe_m = 0.0;   ///< pulses that measure the resistance while there is little power
  double dither_m = 0.0;  ///< by which a muscle that hardly moves proves that it responds
  double pwm_m = 0.0;     ///< power that comes in the PWM's steps
  double delay_m = 0.0;   ///< by which the power comes later than the motion needs it
  double unexplained_m = 0.0;  ///< what the linear model leaves of the motion

  double error_m() const;
};
/// Of what a channel's sensor reads: its noise and its counts, rms.
double reading_noise_m(const ChannelSettings& channel);

/// It was tried for learned_ff on random muscles (docs/setup.md), and for no other law; nor for a
/// loop that has so little margin that it rings.
bool is_promised_for(const control::ControllerSettings& controller, const ChannelSettings& channel,
                     double step_s);
/// channel: with what identify found in it.
Promise promise_error(const control::LearnedFeedforwardSettings& law,
                      const ChannelSettings& channel, const BoardSettings& board,
                      const FirstMotion& motion);

/// The channel with what the board goes by now in place of what its file says.
ChannelSettings with_known(ChannelSettings channel, const KnownMuscle& known);

}  // namespace supercoil
