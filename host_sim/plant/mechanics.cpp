#include "plant/mechanics.hpp"

#include <cmath>

namespace supercoil::host_sim {

namespace {

/// Up to here, three terms of the series in K leave 1e-10 of a step, and eleven in time leave less.
constexpr double max_damping = 0.2;
constexpr double max_stiffness = 0.02;

/// (eᶻ − 1)/z
double once_of(double z) {
  return z == 0.0 ? 1.0 : std::expm1(z) / z;
}

/// (eᶻ − 1 − z)/z²
double twice_of(double z) {
  if (std::abs(z) > 1e-3) return (once_of(z) - 1.0) / z;
  return 0.5 + z * (1.0 / 6.0 + z * (1.0 / 24.0 + z / 120.0));
}

}  // namespace

void Mechanics::set(const control::PhysicalParameters& parameters, double max_stiffness_N_per_m,
                    double step_s) {
  step_s_ = step_s;
  per_mass_ = 1.0 / parameters.moving_mass_kg;
  per_mass_step_ = per_mass_ / step_s;
  damping_ = parameters.damping_Ns_per_m * per_mass_;
  smooth_ = damping_ * step_s < max_damping &&
            max_stiffness_N_per_m * per_mass_ * step_s * step_s < max_stiffness;
  // s(t), with s'' + d s' + K s = 0, s(0) = 0, s'(0) = 1, is a power series in t whose
  // coefficients are polynomials in K: a[n+2] = −d a[n+1] − K a[n], s = Σ a[n] tⁿ/n!.
  once_ = {};
  twice_ = {};
  std::array<double, 3> last{};
  std::array<double, 3> next{1.0, 0.0, 0.0};
  double power = step_s * step_s / 2.0;  // h^(n+1)/(n+1)!
  for (int n = 1; n <= 11; ++n) {
    const double higher = power * step_s / (n + 2.0);
    for (std::size_t j = 0; j < next.size(); ++j) {
      once_[j] += next[j] * power;
      twice_[j] += next[j] * higher;
    }
    power = higher;
    const std::array<double, 3> after{-damping_ * next[0], -damping_ * next[1] - last[0],
                                      -damping_ * next[2] - last[1]};
    last = next;
    next = after;
  }
}

Mechanics::Integrals Mechanics::closed_integrals(double k) const {
  const double half = 0.5 * damping_;
  const double discriminant = half * half - k;
  const double root = std::sqrt(std::abs(discriminant));
  if (discriminant > 1e-6 * half * half) {
    const double slow = -k / (half + root) * step_s_;
    const double fast = -(half + root) * step_s_;
    const double scale = step_s_ * step_s_ / (slow - fast);
    return {(once_of(slow) - once_of(fast)) * scale,
            (twice_of(slow) - twice_of(fast)) * scale * step_s_};
  }
  // Roots close together, or a complex pair: here K is large enough to divide by.
  const double turn = root * step_s_;
  const double odd =
      turn < 1e-4 ? step_s_ : (discriminant > 0.0 ? std::sinh(turn) : std::sin(turn)) / root;
  const double even = discriminant > 0.0 ? std::cosh(turn) : std::cos(turn);
  const double decay = std::exp(-half * step_s_);
  const double response = decay * odd;
  const double once = (1.0 - decay * (even - half * odd) - damping_ * response) / k;
  return {once, (step_s_ - response - damping_ * once) / k};
}

}  // namespace supercoil::host_sim
