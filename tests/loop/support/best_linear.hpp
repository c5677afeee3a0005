// The linear muscle that a nonlinear one is compared with.
#pragma once

#include <vector>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/identification/physical.hpp"

namespace supercoil::test {

/// The linear muscle whose motion under this power is nearest to this motion; both sampled at
/// 100 Hz.
inline control::Theta best_linear(const std::vector<double>& position_m,
                                  const std::vector<double>& power_W, double moving_mass_kg) {
  identification::Samples samples;
  samples.position_m = position_m;
  samples.power_W = power_W;
  const double duration_s = 0.01 * static_cast<double>(position_m.size());
  const auto fit = identification::fit_model({}, samples, {0.0, duration_s});
  identification::Assumed assumed;
  assumed.moving_mass_kg = moving_mass_kg;
  return identification::theta_of(fit, assumed).theta;
}

}  // namespace supercoil::test
