// A real muscle: the paper's equations with the effects that are on.
#pragma once

#include "plant/load_motion.hpp"
#include "plant/muscle_body.hpp"

namespace supercoil::host_sim {

/// Even a muscle's fastest heating and cooling are nearly linear over it.
inline constexpr double max_slow_step_s = 1e-3;

/// A tick divided into equal steps of at most max_slow_step_s.
struct SlowSteps {
  explicit SlowSteps(double tick_s);
  int count;
  double step_s;
};

/// Position is zero for the new, cold muscle that carries its load.
///
/// The slow effects (heat, hysteresis, creep, wear) take one second-order step a tick, or as many
/// as keep it to 1 ms. Spring and force are linear over that step, in which the mechanics take
/// `substeps` exact ones. Without hysteresis and friction the result is within 1e-6 of the
/// equations' solution.
class NonlinearPlant {
 public:
  /// Valid parameters and effects; step_s > 0, the tick.
  NonlinearPlant(const control::PhysicalParameters& parameters, const PlantEffects& effects,
                 double step_s);

  /// One tick. load_N stretches the muscle.
  void step(double power_W, double load_N = 0.0);

  /// Replaces the settings; the muscle's state is kept.
  void set(const control::PhysicalParameters& parameters, const PlantEffects& effects);

  /// A state to start from. Of the muscle's past, only the peak rise is known.
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
  /// Heat lost to the air in the last tick, in J.
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
