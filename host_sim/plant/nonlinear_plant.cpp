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
  substeps_ = effects.substeps;
  per_substep_ = 1.0 / substeps_;
  end_stop_m_ = effects.end_stop_m;
  ceiling_m_ = effects.ceiling_m;
  body_.set(parameters, effects, slow_.step_s);
  friction_.set(parameters, effects);
  mechanics_.set(parameters, body_.max_stiffness_N_per_m(), slow_.step_s * per_substep_);
}

void NonlinearPlant::start_from(const State& state) {
  motion_ = state.motion;
  body_.start_from(state.temperature_rise_K, state.peak_temperature_rise_K, motion_.position_m);
}

void NonlinearPlant::step(double power_W, double load_N) {
  heat_loss_J_ = 0.0;
  for (int i = 0; i < slow_.count; ++i)
    slow_step(power_W, load_N);
}

void NonlinearPlant::slow_step(double power_W, double load_N) {
  const double before_m = motion_.position_m;
  move(body_.step(power_W, load_N, before_m));
  heat_loss_J_ += body_.heat_loss_J();
  body_.moved(0.5 * (before_m + motion_.position_m));
}

void NonlinearPlant::move(const Drive& drive) {
  const double stiffness_step =
      per_substep_ * (drive.stiffness_end_N_per_m - drive.stiffness_N_per_m);
  const double force_step = per_substep_ * (drive.force_end_N - drive.force_N);
  Drive part{drive.stiffness_N_per_m, drive.stiffness_N_per_m + stiffness_step, drive.force_N,
             drive.force_N + force_step};
  Motion motion = motion_;
  for (int i = 0; i < substeps_; ++i) {
    motion =
        friction_.on() ? friction_.step(motion, part, mechanics_) : mechanics_.step(motion, part);
    if (motion.position_m < end_stop_m_) motion = {end_stop_m_, 0.0};
    if (motion.position_m > ceiling_m_) motion = {ceiling_m_, 0.0};
    part.stiffness_N_per_m = part.stiffness_end_N_per_m;
    part.stiffness_end_N_per_m += stiffness_step;
    part.force_N = part.force_end_N;
    part.force_end_N += force_step;
  }
  motion_ = motion;
}

}  // namespace supercoil::host_sim
