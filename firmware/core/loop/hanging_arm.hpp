// What it takes of one muscle to lift an arm that nothing but its weight draws back.
#pragma once

#include "supercoil/control/actuator/parameters.hpp"

#include "loop/settings.hpp"

namespace supercoil {

/// At rest, by the linear model. The weight's pull follows from the angle, whatever the muscle's
/// heat; where the arm rises above the level it eases with each degree.
class HangingArm {
 public:
  /// joint: weighs(). muscle: describes muscle and weight together, at the angle 0.
  HangingArm(const PlaceInJoint& joint, const control::PhysicalParameters& muscle);

  /// Of the weight alone, at the angle 0.
  static double stiffness_at_zero_N_per_m(const PlaceInJoint& joint);

  /// position_m: how far the muscle has contracted. What the weight draws it with there.
  double pull_N(double position_m) const;
  /// What is left of the described stiffness without the weight's.
  double own_stiffness_N_per_m() const { return own_stiffness_N_per_m_; }
  /// Of muscle and weight together. At most 0: no power holds the arm there, it tips over.
  double stiffness_N_per_m(double position_m) const;
  /// That holds it there.
  double power_W(double position_m) const;
  /// How far this much power holds it, up to max_m and to where it tips over.
  double held_m(double power_W, double max_m) const;
  /// From where on it tips over; max_m: nowhere before.
  double tips_over_m(double max_m) const;

 private:
  PlaceInJoint joint_;
  double own_stiffness_N_per_m_;
  double W_per_N_;
};

}  // namespace supercoil
