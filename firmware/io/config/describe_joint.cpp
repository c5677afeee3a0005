#include <cmath>
#include <numbers>
#include <sstream>

#include "config/describe.hpp"
#include "loop/feasibility.hpp"

namespace supercoil::config {

namespace {

double to_tenth(double value) {
  return std::nearbyint(10.0 * value) / 10.0;
}

double to_hundredth(double value) {
  return std::nearbyint(100.0 * value) / 100.0;
}

/// That steady heat makes the muscle pull with while it is held still.
double heat_N(const ChannelSettings& channel, double power_W) {
  const control::PhysicalParameters& m = channel.muscle;
  return power_W / m.heat_transfer_W_per_K * m.force_per_kelvin_N_per_K;
}

double degrees(double angle_rad) {
  return angle_rad * 180.0 / std::numbers::pi;
}

/// "12.3 mm (47 °)"
std::string arc(double arc_m, const control::Lever& lever) {
  std::ostringstream out;
  out << to_tenth(1e3 * arc_m) << " mm (" << to_tenth(degrees(lever.angle_rad(arc_m))) << "°)";
  return out.str();
}

/// "15 mm", or "12 to 15 mm over -40° to 40°; 14.5 mm at 0°"
std::string radius(const control::Lever& lever) {
  std::ostringstream out;
  if (lever.is_constant()) {
    out << 1e3 * lever.zero_radius_m() << " mm";
    return out.str();
  }
  out << 1e3 * lever.min_radius_m() << " to " << 1e3 * lever.max_radius_m() << " mm over "
      << to_tenth(degrees(lever.first_rad())) << "° to " << to_tenth(degrees(lever.last_rad()))
      << "°; " << 1e3 * lever.zero_radius_m() << " mm at 0°";
  return out.str();
}

/// Of both springs at the lever: "0.0036 Nm/rad"
std::string turning_stiffness(double stiffness_N_per_m, const control::Lever& lever) {
  const double min = stiffness_N_per_m * lever.min_radius_m() * lever.min_radius_m();
  const double max = stiffness_N_per_m * lever.max_radius_m() * lever.max_radius_m();
  std::ostringstream out;
  out << min;
  if (!lever.is_constant()) out << " to " << max;
  out << " Nm/rad";
  return out.str();
}

}  // namespace

std::string describe_joint(const BoardConfig& config, std::size_t index) {
  const BoardSettings& board = config.settings;
  const JointSettings& joint = board.joints[index];
  const ChannelSettings& agonist = board.channels[joint.agonist];
  const ChannelSettings& antagonist = board.channels[joint.antagonist];
  const double gain_ratio = antagonist.muscle.dc_gain_m_per_W() / agonist.muscle.dc_gain_m_per_W();
  std::ostringstream out;
  out << "joint " << index + 1 << ": " << config.joints[index].name << "\n"
      << "  muscles     agonist channel " << joint.agonist + 1 << ", antagonist channel "
      << joint.antagonist + 1 << "; lever of " << radius(joint.lever) << "\n"
      << "  range       held for good by one muscle alone: from "
      << arc(-feasibility(antagonist, board).travel_m, joint.lever) << " to "
      << arc(feasibility(agonist, board).travel_m, joint.lever) << "\n"
      << "  both pull   with " << to_tenth(joint.co_contraction_W) << " W and "
      << to_tenth(joint.co_contraction_W / gain_ratio)
      << " W while the joint asks for no effort, of which each takes half\n"
      << "              at most with " << to_tenth(joint.max_co_contraction_W) << " W and "
      << to_tenth(joint.max_co_contraction_W / gain_ratio) << " W, by which heat adds "
      << to_hundredth(heat_N(agonist, joint.max_co_contraction_W)) << " N and "
      << to_hundredth(heat_N(antagonist, joint.max_co_contraction_W / gain_ratio))
      << " N to their pull; what they bear is not configured\n"
      << "  stiffness   " << agonist.muscle.stiffness_N_per_m << " N/m at the lever, "
      << turning_stiffness(agonist.muscle.stiffness_N_per_m, joint.lever)
      << ", however much both pull: linear muscles at the same lever\n";
  return out.str();
}

}  // namespace supercoil::config
