#include "supercoil/control/actuator/state_space.hpp"

namespace supercoil::control {

ActuatorStateSpace state_space(const PhysicalParameters& p) {
  ActuatorStateSpace system;
  system.a << -p.heat_transfer_W_per_K / p.thermal_mass_J_per_K, 0.0, 0.0,  //
      0.0, 0.0, 1.0,                                                        //
      p.force_per_kelvin_N_per_K / p.moving_mass_kg, -p.stiffness_N_per_m / p.moving_mass_kg,
      -p.damping_Ns_per_m / p.moving_mass_kg;
  system.b << 1.0 / p.thermal_mass_J_per_K, 0.0,  //
      0.0, 0.0,                                   //
      0.0, -1.0 / p.moving_mass_kg;
  return system;
}

}  // namespace supercoil::control
