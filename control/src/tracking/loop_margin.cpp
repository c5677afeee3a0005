#include "supercoil/control/tracking/loop_margin.hpp"

#include "supercoil/control/tracking/frequency_response.hpp"
#include "supercoil/control/tracking/sampled_loop.hpp"

namespace supercoil::control {

namespace {

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

/// margin_of: what a muscle's loop has.
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
  return {spectral_radius(law, muscle, step_s, delay_s), modulus(law, muscle, step_s, delay_s)};
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
