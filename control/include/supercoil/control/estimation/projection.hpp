// Keeping estimates inside what is physically possible.
#pragma once

#include "supercoil/control/scalar/scalar.hpp"

namespace supercoil::control {

/// lower[i] <= value[i] <= upper[i].
template <class Scalar, int N>
struct Box {
  Vector<Scalar, N> lower;
  Vector<Scalar, N> upper;

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

}  // namespace supercoil::control
