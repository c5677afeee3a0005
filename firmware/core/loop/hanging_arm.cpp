#include "loop/hanging_arm.hpp"

#include <cmath>

namespace supercoil {

namespace {

double weight_N(const PlaceInJoint& joint, double position_m) {
  const double angle_rad = joint.angle_rad(position_m);
  return joint.weight_Nm * std::sin(angle_rad - joint.hangs_at_rad) /
         joint.lever.radius_m(angle_rad);
}

double weight_N_per_m(const PlaceInJoint& joint, double position_m) {
  constexpr double delta_m = 1e-7;
  return (weight_N(joint, position_m + delta_m) - weight_N(joint, position_m - delta_m)) /
         (2.0 * delta_m);
}

/// The position up to which, from 0 on, all are good.
template <class Good>
double last_good_m(double max_m, const Good& good) {
  constexpr int steps = 1000;
  double last_m = 0.0;
  for (int i = 1; i <= steps; ++i) {
    const double position_m = max_m * i / steps;
    if (!good(position_m)) return last_m;
    last_m = position_m;
  }
  return max_m;
}

}  // namespace

HangingArm::HangingArm(const PlaceInJoint& joint, const control::PhysicalParameters& muscle)
    : joint_(joint),
      own_stiffness_N_per_m_(muscle.stiffness_N_per_m - stiffness_at_zero_N_per_m(joint)),
      W_per_N_(muscle.heat_transfer_W_per_K / muscle.force_per_kelvin_N_per_K) {}

double HangingArm::stiffness_at_zero_N_per_m(const PlaceInJoint& joint) {
  return weight_N_per_m(joint, 0.0);
}

double HangingArm::pull_N(double position_m) const {
  return weight_N(joint_, position_m);
}

double HangingArm::stiffness_N_per_m(double position_m) const {
  return own_stiffness_N_per_m_ + weight_N_per_m(joint_, position_m);
}

double HangingArm::power_W(double position_m) const {
  return W_per_N_ * (own_stiffness_N_per_m_ * position_m + pull_N(position_m) - pull_N(0.0));
}

double HangingArm::held_m(double power_W, double max_m) const {
  return last_good_m(tips_over_m(max_m),
                     [&](double position_m) { return this->power_W(position_m) <= power_W; });
}

double HangingArm::tips_over_m(double max_m) const {
  return last_good_m(max_m,
                     [this](double position_m) { return stiffness_N_per_m(position_m) > 0.0; });
}

}  // namespace supercoil
