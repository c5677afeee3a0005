// All members of all templates, for each scalar that the library is built for.
#include "supercoil/control/estimation/estimator.hpp"
#include "supercoil/control/tracking/controller.hpp"

namespace supercoil::control {

template class Fixed<8, 24>;
template class Fixed<16, 48>;

#define SUPERCOIL_INSTANTIATE(Scalar)                               \
  template class StateVariableFilter<Scalar, 2, Hold::zero_order>;  \
  template class StateVariableFilter<Scalar, 2, Hold::first_order>; \
  template class StateVariableFilter<Scalar, 3, Hold::zero_order>;  \
  template class StateVariableFilter<Scalar, 3, Hold::first_order>; \
  template class OnePoleBank<Scalar, 6>;                            \
  template class ParametricModel<Scalar>;                           \
  template class GradientEstimator<Scalar>;                         \
  template class ReferenceModel<Scalar>;                            \
  template class Pi<Scalar>;                                        \
  template class PdFeedforward<Scalar>;                             \
  template class AdaptiveFeedforward<Scalar>;                       \
  template class Mrac<Scalar>;                                      \
  template class ModelFollower<Scalar, Mrac<Scalar>>

SUPERCOIL_INSTANTIATE(double);
SUPERCOIL_INSTANTIATE(float);
SUPERCOIL_INSTANTIATE(Q8_24);

template class ChangeWatch<double>;
template class ChangeWatch<float>;
template class LeastSquaresEstimator<double>;
template class LeastSquaresEstimator<float>;
template class MracLeastSquares<double>;
template class MracLeastSquares<float>;

}  // namespace supercoil::control
