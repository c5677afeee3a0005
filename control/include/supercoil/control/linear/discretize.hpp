// Exact discretisation of small linear systems.
#pragma once

#include <unsupported/Eigen/MatrixFunctions>

#include <Eigen/LU>

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
template <int N, int Inputs>
ZeroOrderHold<N, Inputs> zero_order_hold(const Matrix<double, N>& a,
                                         const Matrix<double, N, Inputs>& b, double step_s) {
  Matrix<double, N + Inputs> block = Matrix<double, N + Inputs>::Zero();
  block.template topLeftCorner<N, N>() = a * step_s;
  block.template topRightCorner<N, Inputs>() = b * step_s;
  const Matrix<double, N + Inputs> exponential = block.exp();
  return {exponential.template topLeftCorner<N, N>(),
          exponential.template topRightCorner<N, Inputs>()};
}

/// The same with u a straight line from sample to sample.
template <int N, int Inputs>
FirstOrderHold<N, Inputs> first_order_hold(const Matrix<double, N>& a,
                                           const Matrix<double, N, Inputs>& b, double step_s) {
  constexpr int size = N + 2 * Inputs;
  Matrix<double, size> block = Matrix<double, size>::Zero();
  block.template topLeftCorner<N, N>() = a * step_s;
  block.template block<N, Inputs>(0, N) = b * step_s;
  block.template block<Inputs, Inputs>(N, N + Inputs).setIdentity();
  const Matrix<double, size> exponential = block.exp();
  FirstOrderHold<N, Inputs> result;
  result.transition = exponential.template topLeftCorner<N, N>();
  result.end = exponential.template block<N, Inputs>(0, N + Inputs);
  result.start = exponential.template block<N, Inputs>(0, N) - result.end;
  return result;
}

}  // namespace supercoil::control
