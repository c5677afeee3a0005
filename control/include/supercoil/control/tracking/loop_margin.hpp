// How much room a fixed law leaves on a muscle, sampled and delayed, and what noise makes of it.
#pragma once

#include "supercoil/control/tracking/controller_settings.hpp"

namespace supercoil::control {

/// How much room a loop of a fixed law and a muscle has.
struct LoopMargin {
  double spectral_radius = 0.0;  ///< of the sampled loop, for each tick; stable below 1
  /// Least |1 + L(jω)|, the distance of the loop's frequency response from −1: 1 over the largest
  /// amplification of disturbances. 0 when unstable.
  double modulus = 1.0;
  bool stable() const { return spectral_radius < 1.0; }
};

/// step_s: of the loop, > 0. delay_s: from a position's sampling until the power that answers it
/// acts, beyond the hold of a tick; >= 0. Allocates.
LoopMargin loop_margin(const FixedLaw& law, const PhysicalParameters& muscle, double step_s,
                       double delay_s);

/// How far the power swings by noise of the position, rms over rms, that is another one at every
/// tick. step_s and delay_s as above. Says nothing where the loop is unstable.
double noise_gain_W_per_m(const FixedLaw& law, const PhysicalParameters& muscle, double step_s,
                          double delay_s);

/// Of the muscles at the 64 corners where each parameter is (1 ± span) times as large, the one with
/// the least room. span: 0 to less than 1.
struct WorstCorner {
  LoopMargin margin;
  PhysicalParameters muscle;
  int unstable = 0;  ///< corners of 64
};
/// step_s and delay_s as for loop_margin(). Allocates.
WorstCorner worst_corner(const FixedLaw& law, const PhysicalParameters& nominal, double span,
                         double step_s, double delay_s);
/// The same with the law that follows from each corner itself. Not for open loop.
WorstCorner worst_corner_adapted(const ControllerSettings& settings,
                                 const PhysicalParameters& nominal, double span, double step_s,
                                 double delay_s);

/// The largest span, to 1 %, up to which all corners are stable; 0.9 at most.
double tolerated_span(const FixedLaw& law, const PhysicalParameters& nominal, double step_s,
                      double delay_s);

}  // namespace supercoil::control
