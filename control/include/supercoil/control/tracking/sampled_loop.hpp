// A fixed law on a muscle as it is on a board: sampled, held and delayed.
#pragma once

#include "supercoil/control/tracking/fixed_law.hpp"

namespace supercoil::control {

/// Of the loop's poles, for each tick: it is stable below 1. step_s: > 0; delay_s: >= 0, a delay of
/// more than 16 ticks to within 1 %. Allocates.
double spectral_radius(const FixedLaw& law, const PhysicalParameters& muscle, double step_s,
                       double delay_s);

}  // namespace supercoil::control
