// The weight of an arm, instead of a spring or a second muscle.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "config/read_joint.hpp"
#include "loop/hanging_arm.hpp"

namespace supercoil::config {

namespace {

constexpr const char* weight_key = "weight_Nm";
constexpr const char* angle_key = "hangs_at_deg";
constexpr double deg_per_rad = 180.0 / std::numbers::pi;

void refuse_upright(Section& section, const ChannelSettings& channel) {
  const PlaceInJoint& joint = channel.joint;
  const double end_rad = joint.angle_rad(channel.supervision.max_travel_m);
  const double upright_rad = joint.hangs_at_rad + std::numbers::pi;
  if (!(end_rad >= upright_rad)) return;
  std::ostringstream message;
  message << "lets the arm stand upright at " << deg_per_rad * upright_rad
          << "°, from where nothing pulls it back, and its travel goes up to "
          << deg_per_rad * end_rad << "°";
  section.wrong(angle_key, message.str());
}

/// The configured stiffness is of muscle and weight together, so it must exceed the weight's.
void refuse_heavier(Section& section, const ChannelSettings& channel, std::size_t number) {
  const double weight_N_per_m = HangingArm::stiffness_at_zero_N_per_m(channel.joint);
  const double all_N_per_m = channel.muscle.stiffness_N_per_m;
  if (!(all_N_per_m <= weight_N_per_m)) return;
  std::ostringstream message;
  message << "alone makes the joint " << weight_N_per_m << " N/m stiff at 0°, and channel["
          << number << "].muscle.stiffness_N_per_m = " << all_N_per_m
          << " is that of muscle and weight together: raise it, or reduce the weight to less than "
          << channel.joint.weight_Nm * all_N_per_m / weight_N_per_m;
  section.wrong(weight_key, message.str());
}

}  // namespace

void read_weight(Section& section, PlaceInJoint& joint) {
  const double weight_Nm = section.required_number(weight_key, weight_range_Nm);
  const double hangs_at_deg = section.required_number(angle_key, hangs_at_range_deg);
  // What is missing or wrong has been reported.
  if (!std::isfinite(weight_Nm) || !std::isfinite(hangs_at_deg)) return;
  joint.weight_Nm = weight_Nm;
  joint.hangs_at_rad = hangs_at_deg / deg_per_rad;
}

void refuse_weight(Section& section, const ChannelSettings& channel, std::size_t number) {
  if (!channel.joint.weighs()) return;
  refuse_upright(section, channel);
  refuse_heavier(section, channel, number);
}

}  // namespace supercoil::config
