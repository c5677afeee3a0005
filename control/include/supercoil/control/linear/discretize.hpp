// Exact discretisation of small linear systems.
#pragma once

#include "supercoil/control/scalar/scalar.hpp"

namespace supercoil::control {

/// x[k+1] = transition·x[k] + held·u[k], exact while u is constant over the step.
template <int N, int Inputs>
struct ZeroOrderHold {
  Matrix<double, N> transition;
  Matrix<double, N, Inputs> held;
};

/// x[k+1] = transition·x[k] + start·u[k] + end·u[k+1], exact while u is a straight line.
template <int N, int Inputs>
struct FirstOrderHold {
  Matrix<double, N> transition;
  Matrix<double, N, Inputs> start;
  Matrix<double, N, Inputs> end;
};

/// ẋ = A x + B u, step in seconds (> 0). The exponential of [[A, B], [0, 0]] (Van Loan 1978).
/// Instantiated in discretize.cpp, for the sizes named there: the matrix exponential takes half a
/// minute to compile, and otherwise every user of a filter would compile it.
template <int N, int Inputs>
ZeroOrderHold<N, Inputs> zero_order_hold(const Matrix<double, N>& a,
                                         const Matrix<double, N, Inputs>& b, double step_s);

/// The same with u linear between samples.
template <int N, int Inputs>
FirstOrderHold<N, Inputs> first_order_hold(const Matrix<double, N>& a,
                                           const Matrix<double, N, Inputs>& b, double step_s);

}  // namespace supercoil::control
