#include "plant/bundle_plant.hpp"

namespace supercoil::host_sim {

BundlePlant::BundlePlant(const std::vector<BundledMuscle>& muscles, double step_s)
    : slow_(step_s), bodies_(muscles.size()) {
  set(muscles);
}

void BundlePlant::set(const std::vector<BundledMuscle>& muscles) {
  const BundledMuscle& first = muscles.front();
  const double share = 1.0 / static_cast<double>(muscles.size());
  control::PhysicalParameters moved = first.parameters;
  moved.damping_Ns_per_m = 0.0;
  double max_stiffness_N_per_m = 0.0;
  for (std::size_t i = 0; i < muscles.size(); ++i) {
    BundledMuscle muscle = muscles[i];
    muscle.effects.hanging_mass_kg = share * first.effects.hanging_mass_kg;
    bodies_[i].set(muscle.parameters, muscle.effects, slow_.step_s);
    moved.damping_Ns_per_m += muscle.parameters.damping_Ns_per_m;
    max_stiffness_N_per_m += bodies_[i].max_stiffness_N_per_m();
  }
  load_.set(moved, first.effects, max_stiffness_N_per_m, slow_.step_s);
}

void BundlePlant::step(std::span<const double> power_W, double load_N) {
  for (int i = 0; i < slow_.count; ++i)
    slow_step(power_W, load_N);
}

void BundlePlant::slow_step(std::span<const double> power_W, double load_N) {
  const double before_m = load_.position_m();
  Drive all{0.0, 0.0, -load_N, -load_N};
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Drive one = bodies_[i].step(power_W[i], 0.0, before_m);
    all.stiffness_N_per_m += one.stiffness_N_per_m;
    all.stiffness_end_N_per_m += one.stiffness_end_N_per_m;
    all.force_N += one.force_N;
    all.force_end_N += one.force_end_N;
  }
  load_.move(all);
  for (MuscleBody& body : bodies_)
    body.step_creep(0.5 * (before_m + load_.position_m()));
}

}  // namespace supercoil::host_sim
