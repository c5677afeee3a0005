// The paper's muscle, simulated exactly.
#pragma once

#include "supercoil/control/actuator/state_space.hpp"
#include "supercoil/control/linear/discretize.hpp"

namespace supercoil::host_sim {

/// Eqs. (1) and (2), linear. Power and load are constant over a tick, so that the discretisation is
/// exact for any step: substeps only refine what is observed within a tick.
class LinearPlant {
 public:
  /// Valid parameters; step_s > 0, the tick; substeps >= 1.
  LinearPlant(const control::PhysicalParameters& parameters, double step_s, int substeps = 1);

  /// One tick. load_N stretches the muscle.
  void step(double power_W, double load_N = 0.0);

  /// New parameters from now on; the state stays (temperature, position and velocity are physical).
  void set_parameters(const control::PhysicalParameters& parameters);

  const control::PhysicalParameters& parameters() const { return parameters_; }
  double temperature_rise_K() const { return state_[0]; }
  double position_m() const { return state_[1]; }
  double velocity_m_per_s() const { return state_[2]; }
  /// The highest rise so far at any substep.
  double peak_temperature_rise_K() const { return peak_temperature_rise_K_; }

 private:
  control::PhysicalParameters parameters_;
  double substep_s_;
  int substeps_;
  control::ZeroOrderHold<3, 2> discrete_;
  control::Vector<double, 3> state_ = control::Vector<double, 3>::Zero();
  double peak_temperature_rise_K_ = 0.0;
};

}  // namespace supercoil::host_sim
