// Stability and positive realness of the small polynomials used in designs.
#pragma once

#include <array>
#include <cstddef>

namespace supercoil::control {

/// Coefficients in ascending powers: c[0] + c[1] s + … + c[Degree] s^Degree.
template <std::size_t Degree>
using Polynomial = std::array<double, Degree + 1>;

/// The product, coefficients ascending.
template <std::size_t A, std::size_t B>
constexpr Polynomial<A + B> multiply(const Polynomial<A>& a, const Polynomial<B>& b) {
  Polynomial<A + B> product{};
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j)
      product[i + j] += a[i] * b[j];
  }
  return product;
}

/// (s + pole)².
constexpr Polynomial<2> squared_pole(double pole_rad_per_s) {
  return {pole_rad_per_s * pole_rad_per_s, 2.0 * pole_rad_per_s, 1.0};
}

/// True when all roots are strictly in the left half plane (Routh's test). False when the leading
/// coefficient is not positive, or when any coefficient is NaN.
template <std::size_t Degree>
constexpr bool is_hurwitz(const Polynomial<Degree>& c) {
  constexpr std::size_t width = Degree / 2 + 1;
  std::array<double, width + 1> above{};
  std::array<double, width + 1> below{};
  for (std::size_t i = 0; i < width; ++i) {
    above[i] = 2 * i <= Degree ? c[Degree - 2 * i] : 0.0;
    below[i] = 2 * i + 1 <= Degree ? c[Degree - 2 * i - 1] : 0.0;
  }
  if (!(above[0] > 0.0)) return false;
  for (std::size_t row = 1; row <= Degree; ++row) {
    if (!(below[0] > 0.0)) return false;
    std::array<double, width + 1> next{};
    for (std::size_t i = 0; i < width; ++i) {
      next[i] = above[i + 1] - above[0] / below[0] * below[i + 1];
    }
    above = below;
    below = next;
  }
  return true;
}

/// What decides whether a transfer function of relative degree one is strictly positive real.
struct PositiveRealness {
  bool hurwitz;            ///< the denominator has all its roots in the left half plane
  bool high_frequency;     ///< lim ω² Re G(jω) > 0
  double min_real_part;    ///< the minimum of Re G(jω)·|D(jω)|² over all ω
  double worst_rad_per_s;  ///< where it is reached (infinity when it falls without bound)
  bool strict() const { return hurwitz && high_frequency && min_real_part > 0.0; }
};

/// G = (n2 s² + n1 s + n0)/(s³ + d2 s² + d1 s + d0), closed form: Re N(jω)D(−jω) is a parabola in
/// ω².
PositiveRealness positive_realness(const Polynomial<2>& numerator,
                                   const Polynomial<3>& denominator);

}  // namespace supercoil::control
