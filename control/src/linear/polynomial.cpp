#include "supercoil/control/linear/polynomial.hpp"

#include <cmath>
#include <limits>

namespace supercoil::control {

PositiveRealness positive_realness(const Polynomial<2>& n, const Polynomial<3>& d) {
  // With w = ω²: Re N D* = n0 d0 + w (n1 d1 − n0 d2 − n2 d0) + w² (n2 d2 − n1 d3).
  const double constant = n[0] * d[0];
  const double linear = n[1] * d[1] - n[0] * d[2] - n[2] * d[0];
  const double square = n[2] * d[2] - n[1] * d[3];
  PositiveRealness result{};
  result.hurwitz = is_hurwitz<3>(d);
  result.high_frequency = square > 0.0;
  if (square < 0.0) {
    result.min_real_part = -std::numeric_limits<double>::infinity();
    result.worst_rad_per_s = std::numeric_limits<double>::infinity();
    return result;
  }
  const double at = square > 0.0 ? std::fmax(0.0, -linear / (2.0 * square)) : 0.0;
  result.min_real_part = constant + at * (linear + at * square);
  result.worst_rad_per_s = std::sqrt(at);
  return result;
}

}  // namespace supercoil::control
