// The muscle as the Kalman filters believe it to be: its motion and its parameters in one state.
#pragma once

#include <cmath>

#include "supercoil/control/actuator/parameters.hpp"

namespace supercoil::host_sim::estimators {

/// What is estimated, in this order.
enum Index : int {
  at_position,
  at_velocity,
  at_acceleration,
  at_ln_theta_1,  ///< natural logarithm of θ1 in its SI unit; θ2, θ3 and θ4 follow
  at_bias = at_ln_theta_1 + 4,  ///< constant: part of the reported power that does not heat
};
inline constexpr int motion_size = 3;
inline constexpr int parameter_size = 4;
inline constexpr int state_size = motion_size + parameter_size + 1;

using State = control::Vector<double, state_size>;
using Covariance = control::Matrix<double, state_size>;

/// At rest.
State state_of(const control::Theta& theta);
control::Theta theta_of(const State& state);

/// The state a tick later, power held: θ1 m̂x⃛ + θ2 ẍ + θ3 ẋ + θ4 x = P − bias. Scalar: double, or
/// one that carries its derivatives along. The series of the matrix exponential, applied to the
/// state.
template <class Scalar>
control::Vector<Scalar, state_size> propagated(const control::Vector<Scalar, state_size>& state,
                                               double moving_mass_kg, double power_W,
                                               double step_s) {
  using std::exp;
  // Exact to 1e-9 of the motion while the muscle's rates are below 0.5/step_s.
  constexpr int terms = 9;
  const Scalar scale = exp(Scalar(-state[at_ln_theta_1])) / moving_mass_kg;
  const Scalar of_acceleration = exp(state[at_ln_theta_1 + 1]) * scale;
  const Scalar of_velocity = exp(state[at_ln_theta_1 + 2]) * scale;
  const Scalar of_position = exp(state[at_ln_theta_1 + 3]) * scale;

  control::Vector<Scalar, state_size> next = state;
  Scalar drive = (power_W - state[at_bias]) * scale;
  Scalar x = state[at_position];
  Scalar v = state[at_velocity];
  Scalar a = state[at_acceleration];
  for (int k = 1; k <= terms; ++k) {
    const double part = step_s / k;
    const Scalar jerk = drive - of_acceleration * a - of_velocity * v - of_position * x;
    x = v * part;
    v = a * part;
    a = jerk * part;
    drive = Scalar(0.0);  // constant: it has no further derivative
    next[at_position] += x;
    next[at_velocity] += v;
    next[at_acceleration] += a;
  }
  return next;
}

/// The state a tick later, and its derivative by the state.
struct Propagated {
  State state;
  Covariance derivative;
};
Propagated propagated_with_derivative(const State& state, double moving_mass_kg, double power_W,
                                      double step_s);

}  // namespace supercoil::host_sim::estimators
