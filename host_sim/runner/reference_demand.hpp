// What a reference asks of a muscle over time, whatever a loop makes of it.
#pragma once

#include "runner/power_left.hpp"
#include "runner/wanted_motion.hpp"
#include "scenario/scenario.hpp"

namespace supercoil::host_sim {

/// Of a linear muscle that follows its reference model: it has caught up when its heat is what the
/// motion needs.
class ReferenceDemand {
 public:
  /// load_N: that pulls the muscle longer. left: as a scenario begins. tolerated_ratio: of the
  /// greatest power, beyond a limit, while it is not behind.
  ReferenceDemand(const Conditions& c, const control::PhysicalParameters& muscle, double load_N,
                  const PowerLeft& left, double step_s, double tolerated_ratio = rounding_ratio);

  /// The motion begins here, at rest.
  void start_at(double position_m) { motion_.start_at(position_m); }
  /// Other conditions from now on; motion and heat stay.
  void change(const Conditions& c, const control::PhysicalParameters& muscle, double load_N);

  struct Excess {
    LimitedBy by = LimitedBy::nothing;  ///< which limit it asks to go beyond
    double power_W = 0.0;               ///< by how much; below 0: it stays within
    bool unmet = false;                 ///< the muscle, or its shaped motion, lacks power
  };
  /// Over the step that begins now.
  Excess step(double reference_m);

  double asked_m() const { return motion_.asked_m(); }
  double behind_m() const { return motion_.asked_m() - motion_.shaped_m() + lag_.behind_m(); }

 private:
  static constexpr double rounding_ratio = 1e-9;
  static constexpr double unmet_ratio = 1e-3;  ///< of the greatest power: noise hides less

  double step_s_;
  control::PowerRange range_;
  double tolerated_W_;
  double given_ratio_;  ///< what arrives of the power
  double gain_m_per_W_;
  double load_W_;
  WantedMotion motion_;
  Lag lag_;
  PowerLeft left_;
  PowerLeft::Most cold_;
};

}  // namespace supercoil::host_sim
