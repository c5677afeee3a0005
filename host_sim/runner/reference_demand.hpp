// What a reference asks of a muscle over time, whatever the loop does.
#pragma once

#include "runner/available_power.hpp"
#include "runner/demanded_motion.hpp"
#include "scenario/scenario.hpp"

namespace supercoil::host_sim {

/// For a linear muscle that follows its reference model. It has caught up when its heat is what the
/// motion needs.
class ReferenceDemand {
 public:
  /// load_N stretches the muscle. available: at the beginning of a scenario. tolerated_ratio:
  /// tolerated excess beyond a limit over the maximum power, while the muscle is not behind.
  ReferenceDemand(const Conditions& c, const control::PhysicalParameters& muscle, double load_N,
                  const AvailablePower& available, double step_s,
                  double tolerated_ratio = rounding_ratio);

  /// The motion begins here, at rest.
  void start_at(double position_m) { motion_.start_at(position_m); }
  /// Replaces the conditions; motion and heat are kept.
  void change(const Conditions& c, const control::PhysicalParameters& muscle, double load_N);

  struct Excess {
    LimitedBy by = LimitedBy::nothing;  ///< the limit that it exceeds
    double power_W = 0.0;               ///< by how much; below 0: within the limit
    bool unmet = false;                 ///< the muscle, or its shaped motion, lacks power
  };
  /// Over the step that begins now.
  Excess step(double reference_m);

  double demanded_m() const { return motion_.demanded_m(); }
  double behind_m() const { return motion_.demanded_m() - motion_.shaped_m() + lag_.behind_m(); }

 private:
  static constexpr double rounding_ratio = 1e-9;
  static constexpr double unmet_ratio = 1e-3;  ///< of the maximum power: noise hides less

  double step_s_;
  control::PowerRange range_;
  double tolerated_W_;
  double given_ratio_;  ///< power that arrives over power given
  double gain_m_per_W_;
  double load_W_;
  DemandedMotion motion_;
  Lag lag_;
  AvailablePower available_;
  AvailablePower::Limit cold_;
};

}  // namespace supercoil::host_sim
