#include "supercoil/control/tracking/loop_margin.hpp"

#include <cmath>
#include <complex>
#include <numbers>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/tracking/sampled_loop.hpp"

namespace supercoil::control {

namespace {

/// A law and a muscle at one frequency: in continuous time, with half a tick for the hold.
struct FrequencyResponse {
  std::complex<double> law_W_per_m;  ///< power over how far the position is too low
  std::complex<double> loop;         ///< L: with the muscle and the delay
};

/// step_s: of the law; delay_s: after which its power acts; frequency_rad_per_s: > 0.
FrequencyResponse response(const FixedLaw& law, const PhysicalParameters& muscle, double step_s,
                           double delay_s, double frequency_rad_per_s) {
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

/// Visits frequencies up to π/step_s, each with the width of its interval, both in rad/s.
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

double modulus(const FixedLaw& law, const PhysicalParameters& muscle, double step_s,
               double delay_s) {
  double least = 1.0;
  for_each_frequency(step_s, [&](double frequency_rad_per_s, double) {
    const auto at = response(law, muscle, step_s, delay_s, frequency_rad_per_s);
    least = std::fmin(least, std::abs(1.0 + at.loop));
  });
  return least;
}

PhysicalParameters corner_of(const PhysicalParameters& nominal, double span, int corner) {
  PhysicalParameters muscle = nominal;
  for (std::size_t i = 0; i < physical_ranges.size(); ++i)
    muscle.*physical_ranges[i].member *= ((corner >> i) & 1) != 0 ? 1.0 + span : 1.0 - span;
  return muscle;
}

constexpr int corners = 1 << physical_ranges.size();

/// margin_of: gives the margin of a muscle's loop.
template <class Margin>
WorstCorner worst_of_corners(const PhysicalParameters& nominal, double span,
                             const Margin& margin_of) {
  WorstCorner worst;
  for (int corner = 0; corner < corners; ++corner) {
    const PhysicalParameters muscle = corner_of(nominal, span, corner);
    const LoopMargin margin = margin_of(muscle);
    worst.unstable += static_cast<int>(!margin.stable());
    const bool first = corner == 0;
    const bool worse = margin.stable() && worst.margin.stable()
                           ? margin.modulus < worst.margin.modulus
                           : margin.spectral_radius > worst.margin.spectral_radius;
    if (first || worse) {
      worst.margin = margin;
      worst.muscle = muscle;
    }
  }
  return worst;
}

}  // namespace

LoopMargin loop_margin(const FixedLaw& law, const PhysicalParameters& muscle, double step_s,
                       double delay_s) {
  LoopMargin margin{spectral_radius(law, muscle, step_s, delay_s), 0.0};
  // When the loop is unstable, it passes -1 on the wrong side.
  if (margin.stable()) margin.modulus = modulus(law, muscle, step_s, delay_s);
  return margin;
}

double noise_gain_W_per_m(const FixedLaw& law, const PhysicalParameters& muscle, double step_s,
                          double delay_s) {
  double square_sum = 0.0;
  for_each_frequency(step_s, [&](double frequency_rad_per_s, double width_rad_per_s) {
    const auto at = response(law, muscle, step_s, delay_s, frequency_rad_per_s);
    square_sum += std::norm(at.law_W_per_m / (1.0 + at.loop)) * width_rad_per_s;
  });
  return std::sqrt(square_sum * step_s / std::numbers::pi);
}

WorstCorner worst_corner(const FixedLaw& law, const PhysicalParameters& nominal, double span,
                         double step_s, double delay_s) {
  return worst_of_corners(nominal, span, [&](const PhysicalParameters& muscle) {
    return loop_margin(law, muscle, step_s, delay_s);
  });
}

WorstCorner worst_corner_adapted(const ControllerSettings& settings,
                                 const PhysicalParameters& nominal, double span, double step_s,
                                 double delay_s) {
  return worst_of_corners(nominal, span, [&](const PhysicalParameters& muscle) {
    const auto law = fixed_law(settings, muscle);
    return law ? loop_margin(*law, muscle, step_s, delay_s) : LoopMargin{INFINITY, 0.0};
  });
}

double tolerated_span(const FixedLaw& law, const PhysicalParameters& nominal, double step_s,
                      double delay_s) {
  double stable = 0.0;
  double unstable = 0.9;
  while (unstable - stable > 0.01) {
    const double span = 0.5 * (stable + unstable);
    bool holds = true;
    for (int corner = 0; holds && corner < corners; ++corner)
      holds = spectral_radius(law, corner_of(nominal, span, corner), step_s, delay_s) < 1.0;
    (holds ? stable : unstable) = span;
  }
  return stable;
}

}  // namespace supercoil::control
