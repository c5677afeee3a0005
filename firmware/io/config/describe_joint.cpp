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

/// "12.3 mm (47 °)"
std::string arc(double arc_m, double lever_m) {
  std::ostringstream out;
  out << to_tenth(1e3 * arc_m) << " mm (" << to_tenth(arc_m / lever_m * 180.0 / std::numbers::pi)
      << "°)";
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
      << joint.antagonist + 1 << "; lever of " << 1e3 * joint.lever_m << " mm\n"
      << "  range       held for good by one muscle alone: from "
      << arc(-feasibility(antagonist, board).travel_m, joint.lever_m) << " to "
      << arc(feasibility(agonist, board).travel_m, joint.lever_m) << "\n"
      << "  both pull   with " << to_tenth(joint.co_contraction_W) << " W and "
      << to_tenth(joint.co_contraction_W / gain_ratio)
      << " W while the joint asks for no effort, of which each takes half\n"
      << "              at most with " << to_tenth(joint.max_co_contraction_W) << " W and "
      << to_tenth(joint.max_co_contraction_W / gain_ratio) << " W, by which heat adds "
      << to_hundredth(heat_N(agonist, joint.max_co_contraction_W)) << " N and "
      << to_hundredth(heat_N(antagonist, joint.max_co_contraction_W / gain_ratio))
      << " N to their pull; what they bear is not configured\n"
      << "  stiffness   " << agonist.muscle.stiffness_N_per_m << " N/m at the lever, "
      << agonist.muscle.stiffness_N_per_m * joint.lever_m * joint.lever_m
      << " Nm/rad, however much both pull: linear muscles at a constant lever\n";
  return out.str();
}

}  // namespace supercoil::config
