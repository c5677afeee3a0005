// What a sensor's noise makes of a fixed law's power.
#pragma once

#include "supercoil/control/tracking/controller_settings.hpp"

namespace supercoil::control {

/// How far the power swings by noise of the position, rms over rms, that is another one at every
/// tick. step_s and delay_s as for loop_margin(). Says nothing where the loop is unstable.
double noise_gain_W_per_m(const FixedLaw& law, const PhysicalParameters& muscle, double step_s,
                          double delay_s);

}  // namespace supercoil::control
