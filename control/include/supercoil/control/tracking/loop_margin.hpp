// The margin of a fixed law on a muscle, sampled and delayed, and its amplification of noise.
#pragma once

#include "supercoil/control/tracking/controller_settings.hpp"

namespace supercoil::control {

/// The margin of a loop of a fixed law and a muscle.
struct LoopMargin {
  double spectral_radius = 0.0;  ///< of the sampled loop, for each tick; stable below 1
  /// Minimum of |1 + L(jω)|, the distance of the loop's frequency response from −1: the reciprocal
  /// of the largest amplification of disturbances. 0 when unstable.
  double modulus = 1.0;
  bool stable() const { return spectral_radius < 1.0; }
};

/// step_s: of the loop, > 0. delay_s: from sampling a position until the resulting power acts, in
/// addition to the hold of a tick; >= 0. Allocates.
LoopMargin loop_margin(const FixedLaw& law, const PhysicalParameters& muscle, double step_s,
                       double delay_s);

/// Rms of the power over that of position noise that is independent at every tick. step_s and
/// delay_s as above. Meaningless when the loop is unstable.
double noise_gain_W_per_m(const FixedLaw& law, const PhysicalParameters& muscle, double step_s,
                          double delay_s);

/// The muscle with the smallest margin among the 64 corners where each parameter is multiplied by
/// (1 ± span). span: 0 to less than 1.
struct WorstCorner {
  LoopMargin margin;
  PhysicalParameters muscle;
  int unstable = 0;  ///< corners of 64
};
/// step_s and delay_s as for loop_margin(). Allocates.
WorstCorner worst_corner(const FixedLaw& law, const PhysicalParameters& nominal, double span,
                         double step_s, double delay_s);
/// The same, with the law that results from each corner's own muscle. Not for open loop.
WorstCorner worst_corner_adapted(const ControllerSettings& settings,
                                 const PhysicalParameters& nominal, double span, double step_s,
                                 double delay_s);

/// The largest span, to 1 %, up to which all corners are stable; at most 0.9, and 0 when the
/// nominal muscle's loop is unstable.
double tolerated_span(const FixedLaw& law, const PhysicalParameters& nominal, double step_s,
                      double delay_s);

}  // namespace supercoil::control
