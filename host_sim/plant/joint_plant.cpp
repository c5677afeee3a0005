#include "plant/joint_plant.hpp"

#include <algorithm>
#include <cmath>

namespace supercoil::host_sim {

namespace {

/// In a joint, the pretension replaces the hanging mass.
PlantEffects pulled(PlantEffects effects, double pretension_N) {
  effects.hanging_mass_kg = pretension_N / gravity_m_per_s2;
  return effects;
}

}  // namespace

JointPlant::JointPlant(const JointPlantSettings& settings, double step_s) : slow_(step_s) {
  set(settings);
}

void JointPlant::set(const JointPlantSettings& settings) {
  settings_ = settings;
  radius_m_ = settings.lever.zero_radius_m();
  direction_[1] = -settings.antagonist_lever_ratio;
  per_substep_ = 1.0 / settings.substeps;
  const std::array<const JointMuscle*, 2> muscles{
      &settings.agonist, settings.antagonist ? &*settings.antagonist : nullptr};
  const double lever2 = radius_m_ * radius_m_;
  const double max_ratio = settings.lever.max_radius_m() / radius_m_;
  muscle_damping_Ns_per_m_ = {};
  max_stiffness_N_per_m_ = settings.spring_Nm_per_rad / lever2;
  for (std::size_t i = 0; i < muscles.size(); ++i) {
    pulls_[i] = muscles[i] != nullptr && !muscles[i]->torn;
    if (muscles[i] == nullptr) continue;
    slack_m_[i] = muscles[i]->slack_m;
    bodies_[i].set(muscles[i]->parameters, pulled(muscles[i]->effects, pretension_N(i)),
                   slow_.step_s);
    const double along2 = direction_[i] * direction_[i];
    muscle_damping_Ns_per_m_[i] = along2 * muscles[i]->parameters.damping_Ns_per_m;
    max_stiffness_N_per_m_ += along2 * max_ratio * max_ratio * bodies_[i].max_stiffness_N_per_m();
  }
  for (std::size_t taut = 0; taut < mechanics_.size(); ++taut)
    set_mechanics(taut, 1.0);
  control::PhysicalParameters mass;
  mass.moving_mass_kg = settings.inertia_kg_m2 / lever2;
  PlantEffects rubbing;
  rubbing.friction_ratio = settings.friction_ratio;
  friction_.set(mass, pulled(rubbing, settings.pretension_N));
}

void JointPlant::set_mechanics(std::size_t taut, double lever_ratio) {
  const double lever2 = radius_m_ * radius_m_;
  const double ratio2 = lever_ratio * lever_ratio;
  control::PhysicalParameters joint;
  joint.moving_mass_kg = settings_.inertia_kg_m2 / lever2;
  joint.damping_Ns_per_m = settings_.damping_Nms_per_rad / lever2 +
                           ((taut & 1U) != 0 ? ratio2 * muscle_damping_Ns_per_m_[0] : 0.0) +
                           ((taut & 2U) != 0 ? ratio2 * muscle_damping_Ns_per_m_[1] : 0.0);
  damping_Ns_per_m_[taut] = joint.damping_Ns_per_m;
  mechanics_[taut].set(joint, max_stiffness_N_per_m_, slow_.step_s * per_substep_);
}

void JointPlant::step(double agonist_W, double antagonist_W, double load_Nm) {
  for (int i = 0; i < slow_.count; ++i)
    slow_step({agonist_W, antagonist_W}, load_Nm / radius_m_);
}

void JointPlant::slow_step(const std::array<double, 2>& power_W, double load_N) {
  const double before_m = position_m();
  Drives drives{};
  for (std::size_t i = 0; i < drives.size(); ++i) {
    Drive& d = drives[i];
    d = bodies_[i].step(power_W[i], -pretension_N(i), direction_[i] * before_m + slack_m_[i]);
    // From here on relative to the joint's contraction, without the slack.
    d.force_N -= d.stiffness_N_per_m * slack_m_[i];
    d.force_end_N -= d.stiffness_end_N_per_m * slack_m_[i];
  }
  move(drives, load_N);
  const double after_m = position_m();
  for (std::size_t i = 0; i < drives.size(); ++i)
    bodies_[i].step_creep(0.5 * direction_[i] * (before_m + after_m) + slack_m_[i]);
}

JointPlant::Leverage JointPlant::leverage(double reading_m) const {
  if (settings_.lever.is_constant()) return {};
  const double ratio = settings_.lever.radius_m(reading_m / radius_m_) / radius_m_;
  return {ratio, contraction_m(reading_m) - ratio * reading_m};
}

double JointPlant::weight_N(double reading_m) const {
  if (settings_.weight_Nm == 0.0) return 0.0;
  return settings_.weight_Nm / radius_m_ * std::sin(reading_m / radius_m_ - settings_.hangs_at_rad);
}

void JointPlant::pull(const Drives& drives, double reading_m) {
  const double position_m = contraction_m(reading_m);
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const double spring_N = drives[i].stiffness_N_per_m * direction_[i] * position_m;
    tension_N_[i] = pulls_[i] ? std::max(0.0, drives[i].force_N - spring_N) : 0.0;
  }
}

void JointPlant::move(Drives drives, double load_N) {
  const double lever2 = radius_m_ * radius_m_;
  const double spring_N_per_m = settings_.spring_Nm_per_rad / lever2;
  const bool pretensioned = !settings_.antagonist && settings_.spring_pretensions;
  const double min_m = settings_.min_angle_rad * radius_m_;
  const double max_m = settings_.max_angle_rad * radius_m_;
  Drives step{};
  for (std::size_t i = 0; i < drives.size(); ++i) {
    step[i] = {per_substep_ * (drives[i].stiffness_end_N_per_m - drives[i].stiffness_N_per_m), 0.0,
               per_substep_ * (drives[i].force_end_N - drives[i].force_N), 0.0};
  }
  Motion motion = motion_;
  for (int n = 0; n < settings_.substeps; ++n) {
    // Without an antagonist, the spring can hold the cold muscle's pretension.
    const double beside_N = -load_N - (pretensioned ? settings_.pretension_N : 0.0);
    const double then_m = motion.position_m + mechanics_[0].step_s() * motion.velocity_m_per_s;
    Drive sum{spring_N_per_m, spring_N_per_m, beside_N - weight_N(motion.position_m),
              beside_N - weight_N(then_m)};
    const Leverage now = leverage(motion.position_m);
    const Leverage then = leverage(then_m);
    std::size_t taut = 0;
    pull(drives, motion.position_m);
    for (std::size_t i = 0; i < drives.size(); ++i) {
      Drive& d = drives[i];
      const Drive from = d;
      d.stiffness_N_per_m += step[i].stiffness_N_per_m;
      d.force_N += step[i].force_N;
      if (tension_N_[i] <= 0.0) continue;
      taut |= std::size_t{1} << i;
      const double along2 = direction_[i] * direction_[i];
      const double from_N_per_m = along2 * from.stiffness_N_per_m;
      const double to_N_per_m = along2 * d.stiffness_N_per_m;
      sum.stiffness_N_per_m += now.ratio * now.ratio * from_N_per_m;
      sum.stiffness_end_N_per_m += then.ratio * then.ratio * to_N_per_m;
      sum.force_N += now.ratio * (direction_[i] * from.force_N - from_N_per_m * now.beside_m);
      sum.force_end_N += then.ratio * (direction_[i] * d.force_N - to_N_per_m * then.beside_m);
    }
    if (!settings_.lever.is_constant()) {
      // The step uses the stiffness at its middle; this keeps the total force at both ends.
      const double middle = 0.5 * (sum.stiffness_N_per_m + sum.stiffness_end_N_per_m);
      sum.force_N += (middle - sum.stiffness_N_per_m) * motion.position_m;
      sum.force_end_N += (middle - sum.stiffness_end_N_per_m) * then_m;
      set_mechanics(taut, 0.5 * (now.ratio + then.ratio));
    }
    const Mechanics& mechanics = mechanics_[taut];
    friction_.set_viscous(damping_Ns_per_m_[taut]);
    motion = friction_.on() ? friction_.step(motion, sum, mechanics) : mechanics.step(motion, sum);
    if (motion.position_m < min_m) motion = {min_m, 0.0};
    if (motion.position_m > max_m) motion = {max_m, 0.0};
  }
  pull(drives, motion.position_m);
  motion_ = motion;
}

}  // namespace supercoil::host_sim
