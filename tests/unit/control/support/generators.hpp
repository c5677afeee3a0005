// RapidCheck generators of numbers and muscles.
#pragma once

#include <limits>

#include <rapidcheck.h>

#include "supercoil/control/actuator/parameters.hpp"

namespace supercoil::test {

/// Fixed-point numbers of all magnitudes, including the extremes.
template <class F>
rc::Gen<F> fixed_numbers() {
  using Raw = typename F::Raw;
  constexpr Raw one = Raw{1} << F::fraction_bits;
  const auto any_magnitude =
      rc::gen::apply([](Raw bits, int shift) { return static_cast<Raw>(bits >> shift); },
                     rc::gen::resize(100, rc::gen::arbitrary<Raw>()),
                     rc::gen::inRange(0, F::integer_bits + F::fraction_bits));
  const auto edges =
      rc::gen::element<Raw>(0, 1, -1, one, -one, one / 2, std::numeric_limits<Raw>::max(),
                            std::numeric_limits<Raw>::min(), std::numeric_limits<Raw>::max() - 1,
                            std::numeric_limits<Raw>::min() + 1);
  return rc::gen::map(rc::gen::weightedOneOf<Raw>({{9, any_magnitude}, {1, edges}}),
                      [](Raw raw) { return F::from_raw(raw); });
}

/// Uniformly distributed reals from low to high.
inline rc::Gen<double> reals(double low, double high) {
  constexpr int steps = 1'000'000;
  return rc::gen::map(rc::gen::inRange(0, steps + 1),
                      [=](int i) { return low + (high - low) * static_cast<double>(i) / steps; });
}

/// Uniformly distributed on a logarithmic scale; low > 0.
inline rc::Gen<double> magnitudes(double low, double high) {
  return rc::gen::map(reals(std::log(low), std::log(high)),
                      [](double logarithm) { return std::exp(logarithm); });
}

/// Muscles whose mechanics, under- or overdamped, are faster than their cooling.
inline rc::Gen<control::PhysicalParameters> muscles() {
  const auto any = rc::gen::apply(
      [](double psi, double eta, double rho, double zeta, double mass, double gamma) {
        return control::PhysicalParameters{psi,  eta,  rho, 2.0 * zeta * std::sqrt(mass * rho),
                                           mass, gamma};
      },
      magnitudes(0.04, 0.6), magnitudes(0.02, 0.4), magnitudes(4.0, 64.0), magnitudes(0.2, 3.0),
      magnitudes(0.02, 0.4), magnitudes(0.002, 0.04));
  return rc::gen::suchThat(any, [](const control::PhysicalParameters& p) {
    const double half = p.damping_Ns_per_m / (2.0 * p.moving_mass_kg);
    const double square = half * half - p.stiffness_N_per_m / p.moving_mass_kg;
    const double slowest = square > 0.0 ? half - std::sqrt(square) : half;
    return slowest > -1.2 * p.thermal_pole_rad_per_s();
  });
}

}  // namespace supercoil::test

namespace rc {
template <int I, int F>
void showValue(const supercoil::control::Fixed<I, F>& value, std::ostream& os) {
  os << static_cast<double>(value) << " (raw " << value.raw() << ")";
}
}  // namespace rc
