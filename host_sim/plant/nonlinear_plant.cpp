#include "plant/nonlinear_plant.hpp"

#include <algorithm>
#include <cmath>

namespace supercoil::host_sim {

SlowSteps::SlowSteps(double tick_s)
    : count(std::max(1, static_cast<int>(std::ceil(tick_s / max_slow_step_s - 1e-6)))),
      step_s(tick_s / count) {}

NonlinearPlant::NonlinearPlant(const control::PhysicalParameters& parameters,
                               const PlantEffects& effects, double step_s)
    : slow_(step_s) {
  set(parameters, effects);
}

void NonlinearPlant::set(const control::PhysicalParameters& parameters,
                         const PlantEffects& effects) {
  parameters_ = parameters;
  body_.set(parameters, effects, slow_.step_s);
  load_.set(parameters, effects, body_.max_stiffness_N_per_m(), slow_.step_s);
}

void NonlinearPlant::start_from(const State& state) {
  load_.start_from(state.motion);
  body_.start_from(state.temperature_rise_K, state.peak_temperature_rise_K, load_.position_m());
}

void NonlinearPlant::step(double power_W, double load_N) {
  heat_loss_J_ = 0.0;
  for (int i = 0; i < slow_.count; ++i)
    slow_step(power_W, load_N);
}

void NonlinearPlant::slow_step(double power_W, double load_N) {
  const double before_m = load_.position_m();
  load_.move(body_.step(power_W, load_N, before_m));
  heat_loss_J_ += body_.heat_loss_J();
  body_.step_creep(0.5 * (before_m + load_.position_m()));
}

}  // namespace supercoil::host_sim
