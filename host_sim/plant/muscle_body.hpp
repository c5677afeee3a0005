// A muscle without the mass that it moves: its heat, and the spring and force that follow from it.
#pragma once

#include "plant/creep.hpp"
#include "plant/force_curve.hpp"
#include "plant/heat_transfer.hpp"
#include "plant/mechanics.hpp"
#include "plant/play_hysteresis.hpp"
#include "plant/softening.hpp"
#include "plant/wear.hpp"

namespace supercoil::host_sim {

/// Position is zero for the new, cold muscle that carries its load, and grows as it contracts.
class MuscleBody {
 public:
  /// Replaces the settings; the muscle's state is kept. step_s: short against its heating.
  void set(const control::PhysicalParameters& parameters, const PlantEffects& effects,
           double step_s);
  /// Starts in a given state. Of the muscle's past, only the peak rise is known.
  void start_from(double rise_K, double peak_rise_K, double position_m);

  /// One thermal step, from this position. Returns what moves the mass over it. load_N stretches
  /// the muscle.
  Drive step(double power_W, double load_N, double position_m);
  /// Reports the mass's mean position over that step.
  void step_creep(double mean_position_m) { creep_.step(mean_position_m); }

  double rise_K() const { return heat_.rise_K(); }
  double peak_rise_K() const { return peak_K_; }
  /// Heat lost to the air in the last step, in J.
  double heat_loss_J() const { return heat_.loss_J(); }
  /// The highest stiffness, which the muscle has when cold.
  double max_stiffness_N_per_m() const {
    return softening_.cold_N_per_m() + creep_.stiffness_N_per_m();
  }
  const Moisture& moisture() const { return moisture_; }

 private:
  /// Spring and force that the muscle's condition makes, without load and creep.
  struct Spring {
    double stiffness_N_per_m;
    double force_N;
  };
  Spring spring_now();

  HeatTransfer heat_;
  PlayHysteresis hysteresis_;
  ForceCurve force_;
  Softening softening_;
  Creep creep_;
  LonelyStroke lonely_;
  Ageing ageing_;
  Moisture moisture_;
  bool wears_ = false;
  double peak_K_ = 0.0;
  Spring spring_{};
};

}  // namespace supercoil::host_sim
