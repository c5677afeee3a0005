// Keeping estimates inside what is physically possible.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "supercoil/control/scalar/scalar.hpp"

namespace supercoil::control {

/// lower[i] <= value[i] <= upper[i].
template <class Scalar, int N>
struct Box {
  Vector<Scalar, N> lower;
  Vector<Scalar, N> upper;

  /// Bounds included; false for NaN.
  bool contains(const Vector<Scalar, N>& value) const {
    return (value.array() >= lower.array()).all() && (value.array() <= upper.array()).all();
  }
};

/// The nearest point of the box. With a diagonal adaptation gain this is the projected gradient law
/// (Ioannou & Fidan 2006, Sec. 3.10) after one Euler step, and keeps its Lyapunov argument.
template <class Scalar, int N>
Vector<Scalar, N> project(const Vector<Scalar, N>& value, const Box<Scalar, N>& box) {
  return value.cwiseMax(box.lower).cwiseMin(box.upper);
}

/// Into the box along the covariance: the value that is the most standard deviations outside goes
/// to its bound and the others to their likeliest values given that, until all are inside. Element
/// by element, the correlations in the data would be lost.
template <int N>
Vector<double, N> project(Vector<double, N> value, const Box<double, N>& box,
                          Matrix<double, N> covariance) {
  std::array<bool, N> known{};
  for (int count = 0; count < N; ++count) {
    int worst = -1;
    double max_deviations = 0.0;
    for (int i = 0; i < N; ++i) {
      const double inside = std::clamp(value[i], box.lower[i], box.upper[i]);
      const double variance = covariance(i, i);
      if (known[static_cast<std::size_t>(i)] || inside == value[i] || !(variance > 0.0)) continue;
      const double deviations = std::abs(value[i] - inside) / std::sqrt(variance);
      if (deviations <= max_deviations) continue;
      max_deviations = deviations;
      worst = i;
    }
    if (worst < 0) break;
    const double bound = std::clamp(value[worst], box.lower[worst], box.upper[worst]);
    const Vector<double, N> along = covariance.col(worst) / covariance(worst, worst);
    value += along * (bound - value[worst]);
    covariance -= along * covariance.row(worst).eval();
    known[static_cast<std::size_t>(worst)] = true;
  }
  return project<double, N>(value, box);
}

}  // namespace supercoil::control
