// The settings of the proof of response for the paper's muscle under the default limits.
#pragma once

#include "supervisor/proof.hpp"

namespace supercoil::test {

inline ProofSettings paper_proof() {
  ProofSettings s;
  s.max_power_ratio = 1.05;
  s.max_W = 4.5;
  s.derate_from_C = 130.0;
  s.trip_C = 160.0;
  s.position_noise_rms_m = 10e-6;
  s.count_m = 0.6e-6;
  return s;
}

/// The power at which the paper's muscle is safe for any time.
inline double paper_safe_W() {
  return plan_proof(paper_proof(), {}, 1000.0).safe_W;
}

inline constexpr double slower = 12.0;

/// 2 J/K: a time constant of 27 s, and a small travel.
inline control::PhysicalParameters slow_muscle() {
  control::PhysicalParameters muscle;
  muscle.thermal_mass_J_per_K *= slower;
  muscle.force_per_kelvin_N_per_K *= 0.2;
  return muscle;
}

inline ProofSettings slow_proof() {
  ProofSettings s = paper_proof();
  s.thermal.bounds.min_mass_J_per_K *= slower;
  s.thermal.bounds.max_mass_J_per_K *= slower;
  return s;
}

}  // namespace supercoil::test
