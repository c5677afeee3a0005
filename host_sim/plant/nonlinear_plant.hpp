// A muscle as it is: the paper's equations with whatever effects are on.
#pragma once

#include "plant/load_motion.hpp"
#include "plant/muscle_body.hpp"

namespace supercoil::host_sim {

/// A muscle's fastest cooling and heating bend little over it.
inline constexpr double max_slow_step_s = 1e-3;

/// A tick in equal steps of at most max_slow_step_s.
struct SlowSteps {
  explicit SlowSteps(double tick_s);
  int count;
  double step_s;
};

/// Position is zero for the new, cold muscle that carries its load.
///
/// What is slow (heat, hysteresis, creep, wear) takes one step of the second order a tick, or as
/// many as keep it below 1 ms; spring and force then are straight lines over that step, in which
/// the mechanics take `substeps` exact ones. Without hysteresis and friction this is within 1e-6 of
/// the equations' solution.
class NonlinearPlant {
 public:
  /// Valid parameters and effects; step_s > 0, the tick.
  NonlinearPlant(const control::PhysicalParameters& parameters, const PlantEffects& effects,
                 double step_s);

  /// One tick. load_N pulls the muscle longer.
  void step(double power_W, double load_N = 0.0);

  /// From now on; whatever the muscle remembers stays.
  void set(const control::PhysicalParameters& parameters, const PlantEffects& effects);

  /// A muscle that is somewhere already, with a past of which nothing is left but its peak.
  struct State {
    double temperature_rise_K;
    double peak_temperature_rise_K;
    Motion motion;
  };
  void start_from(const State& state);

  const control::PhysicalParameters& parameters() const { return parameters_; }
  double temperature_rise_K() const { return body_.rise_K(); }
  double position_m() const { return load_.position_m(); }
  double velocity_m_per_s() const { return load_.velocity_m_per_s(); }
  double peak_temperature_rise_K() const { return body_.peak_rise_K(); }
  /// What the last tick lost to the air, in J.
  double heat_loss_J() const { return heat_loss_J_; }
  const Moisture& moisture() const { return body_.moisture(); }

 private:
  void slow_step(double power_W, double load_N);

  control::PhysicalParameters parameters_;
  SlowSteps slow_;
  MuscleBody body_;
  LoadMotion load_;
  double heat_loss_J_ = 0.0;
};

}  // namespace supercoil::host_sim
