#include "plant/load_motion.hpp"

namespace supercoil::host_sim {

void LoadMotion::set(const control::PhysicalParameters& parameters, const PlantEffects& effects,
                     double max_stiffness_N_per_m, double step_s) {
  substeps_ = effects.substeps;
  per_substep_ = 1.0 / substeps_;
  end_stop_m_ = effects.end_stop_m;
  ceiling_m_ = effects.ceiling_m;
  friction_.set(parameters, effects);
  mechanics_.set(parameters, max_stiffness_N_per_m, step_s * per_substep_);
}

void LoadMotion::move(const Drive& drive) {
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
