#include "supercoil/control/tracking/loop_noise.hpp"

#include "supercoil/control/tracking/frequency_response.hpp"

namespace supercoil::control {

double noise_gain_W_per_m(const FixedLaw& law, const PhysicalParameters& muscle, double step_s,
                          double delay_s) {
  double square_sum = 0.0;
  for_each_frequency(step_s, [&](double frequency_rad_per_s, double width_rad_per_s) {
    const auto at = response(law, muscle, step_s, delay_s, frequency_rad_per_s);
    square_sum += std::norm(at.law_W_per_m / (1.0 + at.loop)) * width_rad_per_s;
  });
  return std::sqrt(square_sum * step_s / std::numbers::pi);
}

}  // namespace supercoil::control
