// Setup of one muscle, from its description to its first motion.
#pragma once

#include <string>

#include "setup/held_out.hpp"
#include "supervisor/fault.hpp"

namespace supercoil::test {

struct Commissioned {
  std::string refused;         ///< what setup said; empty: it came to its end
  double promised_m = 0.0;     ///< NaN: nothing was
  double probe_m = 0.0;        ///< part of that
  double unexplained_m = 0.0;  ///< likewise
  double error_m = 0.0;
  double took_s = 0.0;          ///< of the muscle's time
  double hottest_rise_K = 0.0;  ///< truly
  double travel_m = 0.0;        ///< that it was promised to hold
  Fault fault = Fault::none;
};

/// Throws what a wrong test setting says. controller: its kind, which has learned_ff's keys.
Commissioned commission(const HeldOut& muscle, const std::string& controller = "learned_ff");

}  // namespace supercoil::test
