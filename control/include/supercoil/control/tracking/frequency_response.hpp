// A fixed law and a muscle by their frequency response: in continuous time, with half a tick for
// the hold.
#pragma once

#include <cmath>
#include <complex>
#include <numbers>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/tracking/fixed_law.hpp"

namespace supercoil::control {

/// Of a law and a muscle at one frequency.
struct FrequencyResponse {
  std::complex<double> law_W_per_m;  ///< power by a position that is too low
  std::complex<double> loop;         ///< L: with the muscle and the delay
};

/// step_s: of the law; delay_s: after which its power acts; frequency_rad_per_s: > 0.
inline FrequencyResponse response(const FixedLaw& law, const PhysicalParameters& muscle,
                                  double step_s, double delay_s, double frequency_rad_per_s) {
  const std::complex<double> p{0.0, frequency_rad_per_s};
  const Theta theta = theta_from(muscle);
  const auto lag = p / law.derivative_filter_rad_per_s + 1.0;
  const auto needs =
      ((theta[0] * muscle.moving_mass_kg * p + theta[1]) * p + theta[2]) * p + theta[3];
  const auto late = std::exp(-p * (delay_s + 0.5 * step_s));
  auto acts = law.proportional_W_per_m + law.integral_W_per_m_s / p +
              law.derivative_Ws_per_m * p / (lag * lag);
  if (law.filtered) {
    const FilteredFeedback& f = *law.filtered;
    const auto lambda = (p + f.lambda[1]) * p + f.lambda[0];
    const auto by_position =
        (f.on_position_W_per_m[0] + f.on_position_W_per_m[1] * p) / lambda + f.direct_W_per_m;
    const auto by_power = (f.on_power[0] + f.on_power[1] * p) / lambda;
    acts = (acts - by_position) / (1.0 - by_power * late);
  }
  return {acts, acts / needs * late};
}

/// Frequencies up to that of a tick, each with its part of them, both in rad/s.
template <class Visit>
void for_each_frequency(double step_s, const Visit& visit) {
  constexpr double min_rad_per_s = 0.01;
  constexpr double finer = 1.01;
  const double span = std::log(std::numbers::pi / step_s / min_rad_per_s);
  const auto points = static_cast<int>(span / std::log(finer));
  for (int i = 0; i <= points; ++i) {
    const double frequency_rad_per_s = min_rad_per_s * std::pow(finer, i);
    visit(frequency_rad_per_s, frequency_rad_per_s * std::log(finer));
  }
}

}  // namespace supercoil::control
