#include "estimators/muscle_state.hpp"

#include <unsupported/Eigen/AutoDiff>

namespace supercoil::host_sim::estimators {

State state_of(const control::Theta& theta) {
  State state = State::Zero();
  state.segment<parameter_size>(at_ln_theta_1) = theta.array().log();
  return state;
}

control::Theta theta_of(const State& state) {
  return state.segment<parameter_size>(at_ln_theta_1).array().exp();
}

Propagated propagated_with_derivative(const State& state, double moving_mass_kg, double power_W,
                                      double step_s) {
  using Dual = Eigen::AutoDiffScalar<State>;
  control::Vector<Dual, state_size> dual;
  for (int i = 0; i < state_size; ++i)
    dual[i] = Dual(state[i], state_size, i);
  const control::Vector<Dual, state_size> next = propagated(dual, moving_mass_kg, power_W, step_s);
  Propagated result;
  for (int i = 0; i < state_size; ++i) {
    result.state[i] = next[i].value();
    result.derivative.row(i) = next[i].derivatives().transpose();
  }
  return result;
}

}  // namespace supercoil::host_sim::estimators
