#include "plant/linear_plant.hpp"

#include <algorithm>

namespace supercoil::host_sim {

namespace {

control::ZeroOrderHold<3, 2> discretise(const control::PhysicalParameters& parameters,
                                        double step_s) {
  const control::ActuatorStateSpace system = control::state_space(parameters);
  return control::zero_order_hold<3, 2>(system.a, system.b, step_s);
}

}  // namespace

LinearPlant::LinearPlant(const control::PhysicalParameters& parameters, double step_s, int substeps)
    : parameters_(parameters),
      substep_s_(step_s / substeps),
      substeps_(substeps),
      discrete_(discretise(parameters, substep_s_)) {}

void LinearPlant::step(double power_W, double load_N) {
  const control::Vector<double, 2> input{power_W, load_N};
  const control::Vector<double, 3> drive = discrete_.held * input;
  for (int i = 0; i < substeps_; ++i) {
    state_ = (discrete_.transition * state_ + drive).eval();
    peak_temperature_rise_K_ = std::max(peak_temperature_rise_K_, state_[0]);
  }
}

void LinearPlant::set_parameters(const control::PhysicalParameters& parameters) {
  parameters_ = parameters;
  discrete_ = discretise(parameters, substep_s_);
}

}  // namespace supercoil::host_sim
