// The load that muscles move: a mass between end stops, in a guide with friction.
#pragma once

#include "plant/guide_friction.hpp"
#include "plant/mechanics.hpp"

namespace supercoil::host_sim {

class LoadMotion {
 public:
  /// parameters: mass and damping of all that moves. step_s: of move().
  void set(const control::PhysicalParameters& parameters, const PlantEffects& effects,
           double max_stiffness_N_per_m, double step_s);
  /// Sets the motion to begin with.
  void start_from(const Motion& motion) { motion_ = motion; }

  /// Takes `substeps` steps of the mechanics; spring and force are linear in time over them.
  void move(const Drive& drive);

  double position_m() const { return motion_.position_m; }
  double velocity_m_per_s() const { return motion_.velocity_m_per_s; }

 private:
  int substeps_ = 4;
  double per_substep_ = 0.25;
  double end_stop_m_ = -10.0;
  double ceiling_m_ = 10.0;
  GuideFriction friction_;
  Mechanics mechanics_;
  Motion motion_;
};

}  // namespace supercoil::host_sim
