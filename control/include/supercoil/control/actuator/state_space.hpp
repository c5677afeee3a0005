// The muscle as a linear system in its physical states.
#pragma once

#include "supercoil/control/actuator/parameters.hpp"

namespace supercoil::control {

/// ẋ = A x + B u with x = [temperature_rise_K, position_m, velocity_m_per_s] and
/// u = [power_W, load_N]; the load stretches the muscle (Eqs. (1) and (2)).
struct ActuatorStateSpace {
  Matrix<double, 3> a;
  Matrix<double, 3, 2> b;
};

/// parameters: valid (see PhysicalParameters).
ActuatorStateSpace state_space(const PhysicalParameters& parameters);

}  // namespace supercoil::control
