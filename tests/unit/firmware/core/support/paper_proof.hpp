// What the proof of response rests on for the paper's muscle under the default limits.
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

}  // namespace supercoil::test
