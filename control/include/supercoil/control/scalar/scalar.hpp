// What the control library requires of its scalar types: double, float and Q8_24.
#pragma once

#include <cmath>

#include <Eigen/Core>

#include "supercoil/control/scalar/fixed.hpp"

namespace supercoil::control {

namespace detail {
template <class Scalar>
struct AccumulatorOf {
  using type = double;
};
template <int I, int F>
struct AccumulatorOf<Fixed<I, F>> {
  using type = Q16_48;
};
}  // namespace detail

/// The 64-bit type in which states are accumulated. At 1 kHz a state's increment is a thousandth or
/// less of its change over a time constant: rounded to 32 bits, 2 µm of position.
template <class Scalar>
using Accumulator = typename detail::AccumulatorOf<Scalar>::type;

/// An intentional conversion between double, float and the fixed-point formats.
template <class To, class From>
constexpr To to(const From& value) {
  return static_cast<To>(value);
}

using std::abs;
using std::isfinite;
using std::sqrt;

/// One vector type for all lengths, on the stack.
template <class Scalar, int N>
using Vector = Eigen::Matrix<Scalar, N, 1>;
template <class Scalar, int Rows, int Columns = Rows>
using Matrix = Eigen::Matrix<Scalar, Rows, Columns>;

}  // namespace supercoil::control

namespace Eigen {

/// Lets Eigen calculate with Fixed.
template <int I, int F>
struct NumTraits<supercoil::control::Fixed<I, F>> {
  using Self = supercoil::control::Fixed<I, F>;
  using Real = Self;
  using NonInteger = Self;
  using Literal = Self;
  using Nested = Self;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 2,
    MulCost = 3
  };
  static constexpr Self epsilon() { return Self::resolution(); }
  static constexpr Self dummy_precision() { return Self::from_raw(16); }
  static constexpr Self highest() { return Self::max(); }
  static constexpr Self lowest() { return Self::min(); }
  static constexpr int digits10() { return static_cast<int>(F * 0.30103); }
};

}  // namespace Eigen
