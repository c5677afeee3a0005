// One muscle that lifts an arm, which only its weight draws back.
#pragma once

#include "supercoil/control/actuator/parameters.hpp"

#include "loop/settings.hpp"

namespace supercoil {

/// At rest, by the linear model. The weight's pull depends on the angle alone, not on heat; once
/// the arm rises above level, the pull decreases with every degree.
class HangingArm {
 public:
  /// joint: weighs(). muscle: describes muscle and weight together, at the angle 0.
  HangingArm(const PlaceInJoint& joint, const control::PhysicalParameters& muscle);

  /// Of the weight alone, at the angle 0.
  static double stiffness_at_zero_N_per_m(const PlaceInJoint& joint);

  /// The weight's pull on the muscle. position_m: the muscle's contraction.
  double pull_N(double position_m) const;
  /// The described stiffness without the weight's share.
  double own_stiffness_N_per_m() const { return own_stiffness_N_per_m_; }
  /// Of muscle and weight together. At most 0: no power holds the arm there, it tips over.
  double stiffness_N_per_m(double position_m) const;
  /// The power that holds the arm there.
  double power_W(double position_m) const;
  /// How far this power holds the arm, up to max_m and to where it tips over.
  double held_m(double power_W, double max_m) const;
  /// Where it begins to tip over; max_m: not before.
  double tips_over_m(double max_m) const;

 private:
  PlaceInJoint joint_;
  double own_stiffness_N_per_m_;
  double W_per_N_;
};

}  // namespace supercoil
