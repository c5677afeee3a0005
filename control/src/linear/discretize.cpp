#include "supercoil/control/linear/discretize.hpp"

#include "supercoil/control/linear/matrix_functions.hpp"

namespace supercoil::control {
namespace {

template <int N>
Matrix<double, N> exponential(Matrix<double, N> matrix) {
  static_assert(N <= max_exponential_size);
  replace_by_exponential({matrix.data(), N * N}, N);
  return matrix;
}

}  // namespace

template <int N, int Inputs>
ZeroOrderHold<N, Inputs> zero_order_hold(const Matrix<double, N>& a,
                                         const Matrix<double, N, Inputs>& b, double step_s) {
  Matrix<double, N + Inputs> block = Matrix<double, N + Inputs>::Zero();
  block.template topLeftCorner<N, N>() = a * step_s;
  block.template topRightCorner<N, Inputs>() = b * step_s;
  block = exponential(block);
  return {block.template topLeftCorner<N, N>(), block.template topRightCorner<N, Inputs>()};
}

template <int N, int Inputs>
FirstOrderHold<N, Inputs> first_order_hold(const Matrix<double, N>& a,
                                           const Matrix<double, N, Inputs>& b, double step_s) {
  constexpr int size = N + 2 * Inputs;
  Matrix<double, size> block = Matrix<double, size>::Zero();
  block.template topLeftCorner<N, N>() = a * step_s;
  block.template block<N, Inputs>(0, N) = b * step_s;
  block.template block<Inputs, Inputs>(N, N + Inputs).setIdentity();
  block = exponential(block);
  FirstOrderHold<N, Inputs> result;
  result.transition = block.template topLeftCorner<N, N>();
  result.end = block.template block<N, Inputs>(0, N + Inputs);
  result.start = block.template block<N, Inputs>(0, N) - result.end;
  return result;
}

template ZeroOrderHold<1, 1> zero_order_hold<1, 1>(const Matrix<double, 1>&,
                                                   const Matrix<double, 1, 1>&, double);
template ZeroOrderHold<2, 1> zero_order_hold<2, 1>(const Matrix<double, 2>&,
                                                   const Matrix<double, 2, 1>&, double);
template ZeroOrderHold<3, 1> zero_order_hold<3, 1>(const Matrix<double, 3>&,
                                                   const Matrix<double, 3, 1>&, double);
template ZeroOrderHold<3, 2> zero_order_hold<3, 2>(const Matrix<double, 3>&,
                                                   const Matrix<double, 3, 2>&, double);
template ZeroOrderHold<5, 1> zero_order_hold<5, 1>(const Matrix<double, 5>&,
                                                   const Matrix<double, 5, 1>&, double);
template ZeroOrderHold<7, 1> zero_order_hold<7, 1>(const Matrix<double, 7>&,
                                                   const Matrix<double, 7, 1>&, double);
template FirstOrderHold<1, 1> first_order_hold<1, 1>(const Matrix<double, 1>&,
                                                     const Matrix<double, 1, 1>&, double);
template FirstOrderHold<2, 1> first_order_hold<2, 1>(const Matrix<double, 2>&,
                                                     const Matrix<double, 2, 1>&, double);
template FirstOrderHold<3, 1> first_order_hold<3, 1>(const Matrix<double, 3>&,
                                                     const Matrix<double, 3, 1>&, double);
template FirstOrderHold<3, 2> first_order_hold<3, 2>(const Matrix<double, 3>&,
                                                     const Matrix<double, 3, 2>&, double);
template FirstOrderHold<5, 1> first_order_hold<5, 1>(const Matrix<double, 5>&,
                                                     const Matrix<double, 5, 1>&, double);
template FirstOrderHold<7, 1> first_order_hold<7, 1>(const Matrix<double, 7>&,
                                                     const Matrix<double, 7, 1>&, double);

}  // namespace supercoil::control
