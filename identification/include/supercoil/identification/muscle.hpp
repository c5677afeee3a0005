// A muscle with its effects, as parameters that position and power determine, and its motion.
#pragma once

#include <span>
#include <vector>

#include "supercoil/identification/effects.hpp"
#include "supercoil/identification/samples.hpp"

namespace supercoil::identification {

/// Temperature is expressed as the power that would maintain it: u in W, τ u̇ = P − h(u, P) u.
/// Parameters of effects that are not in the model stay at their neutral values, the defaults.
struct Muscle {
  double gain_m_per_W = 0.0;                  ///< of position at rest
  double time_constant_s = 1.0;               ///< τ, of heat
  double natural_frequency_rad_per_s = 20.0;  ///< of mass and stiffness
  double damping_ratio = 1.0;

  double drift_m_per_s = 0.0;
  double heat_drift_m_per_J = 0.0;  ///< over ∫u dt
  double force_ratio = 1.0;         ///< slope of force where u is full_W over that at 0
  double transfer_ratio = 1.0;      ///< h where u is full_W
  double heated_ratio = 1.0;        ///< of h while heated
  double play_ratio = 0.0;          ///< share of force that comes from plays
  double play_range_W = 1.0;        ///< of the widest of five
  double creep_ratio = 0.0;         ///< share of the motion that is delayed
  double creep_s = 20.0;
  double lonely_stroke_m = 0.0;   ///< by which the rest length grows
  double lonely_stroke_W = 1.0;   ///< at which it is complete
  double transformation_W = 0.0;  ///< where half of the stroke is done
  double transformed_W = 0.0;     ///< scale of the range; 0: no transformation

  // Of the recording, not of the muscle:
  double rest_m = 0.0;          ///< position when cold, at its first row
  double start_W = 0.0;         ///< u at its first row
  double start_offset_m = 0.0;  ///< from the rest position at that u
  double start_m_per_s = 0.0;
};

/// Position at the first `count` samples. full_W > 0: the power that the ratios refer to.
std::vector<double> motion(const Muscle& muscle, const Samples& samples, double full_W,
                           std::size_t count);

}  // namespace supercoil::identification
