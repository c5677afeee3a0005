// A fixed law on a muscle as it is on a board: sampled, held and delayed.
#pragma once

#include "supercoil/control/tracking/fixed_law.hpp"

namespace supercoil::control {

/// Largest magnitude of the loop's poles, per tick; stable below 1. step_s: > 0; delay_s: >= 0,
/// accurate to 1 % above 16 ticks. Allocates.
double spectral_radius(const FixedLaw& law, const PhysicalParameters& muscle, double step_s,
                       double delay_s);

}  // namespace supercoil::control
