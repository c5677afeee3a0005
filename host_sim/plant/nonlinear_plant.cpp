#include "plant/nonlinear_plant.hpp"

#include <algorithm>
#include <cmath>

namespace supercoil::host_sim {

namespace {

/// A muscle's fastest cooling and heating bend little over it.
constexpr double max_slow_step_s = 1e-3;

}  // namespace

NonlinearPlant::NonlinearPlant(const control::PhysicalParameters& parameters,
                               const PlantEffects& effects, double step_s)
    : slow_step_s_(step_s),
      slow_steps_(std::max(1, static_cast<int>(std::ceil(step_s / max_slow_step_s - 1e-6)))) {
  slow_step_s_ = step_s / slow_steps_;
  set(parameters, effects);
}

void NonlinearPlant::set(const control::PhysicalParameters& parameters,
                         const PlantEffects& effects) {
  parameters_ = parameters;
  substeps_ = effects.substeps;
  per_substep_ = 1.0 / substeps_;
  end_stop_m_ = effects.end_stop_m;
  ceiling_m_ = effects.ceiling_m;
  heat_.set(parameters, effects, slow_step_s_);
  hysteresis_.set(effects);
  force_.set(parameters, effects);
  softening_.set(parameters, effects);
  creep_.set(parameters, effects, slow_step_s_);
  lonely_.set(effects);
  ageing_.set(effects);
  moisture_.set(effects, slow_step_s_);
  friction_.set(parameters, effects);
  mechanics_.set(parameters, softening_.cold_N_per_m() + creep_.stiffness_N_per_m(),
                 slow_step_s_ * per_substep_);
  wears_ = effects.ageing_ratio > 0.0 || effects.water_ratio > 0.0 || moisture_.water_ratio() > 0.0;
  muscle_ = muscle_now();
}

void NonlinearPlant::start_from(const State& state) {
  heat_.start_from(state.temperature_rise_K);
  peak_K_ = state.peak_temperature_rise_K;
  motion_ = state.motion;
  hysteresis_.rest_at(state.temperature_rise_K);
  creep_.rest_at(motion_.position_m);
  muscle_ = muscle_now();
}

NonlinearPlant::Muscle NonlinearPlant::muscle_now() {
  const double rise_K = heat_.rise_K();
  const double stiffness = softening_.stiffness_N_per_m(rise_K);
  const double lost = stiffness - softening_.cold_N_per_m();
  double active = force_.force_N(hysteresis_.step(rise_K));
  if (wears_) active *= ageing_.force_ratio() * moisture_.force_ratio();
  // k(x − x0 − xs) + k0 xs
  return {stiffness, active + stiffness * lonely_.rest_m(peak_K_) + lost * softening_.stretch_m()};
}

void NonlinearPlant::step(double power_W, double load_N) {
  heat_loss_J_ = 0.0;
  for (int i = 0; i < slow_steps_; ++i)
    slow_step(power_W, load_N);
}

void NonlinearPlant::slow_step(double power_W, double load_N) {
  const double rise_before_K = heat_.rise_K();
  const double rise_K = heat_.step(power_W);
  heat_loss_J_ += heat_.loss_J();
  peak_K_ = std::max(peak_K_, rise_K);
  if (wears_) {
    ageing_.step(rise_K - rise_before_K);
    moisture_.step(0.5 * (rise_before_K + rise_K));
  }
  const Muscle before = muscle_;
  muscle_ = muscle_now();

  const double position_before_m = motion_.position_m;
  const double pull_N = creep_.pull_N() - load_N;
  const double pull_end_N = pull_N + creep_.pull_change_N(position_before_m);
  const double beside_N_per_m = creep_.stiffness_N_per_m();
  move({before.stiffness_N_per_m + beside_N_per_m, muscle_.stiffness_N_per_m + beside_N_per_m,
        before.force_N + pull_N, muscle_.force_N + pull_end_N});
  creep_.step(0.5 * (position_before_m + motion_.position_m));
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
