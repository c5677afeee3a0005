#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string_view>

#include "config/describe.hpp"
#include "loop/feasibility.hpp"
#include "loop/modelled_pull.hpp"

namespace supercoil::config {

namespace {

double to_tenth(double value) {
  return std::nearbyint(10.0 * value) / 10.0 + 0.0;  // never -0
}

/// Not less than the value.
double up_to_hundredth(double value) {
  return std::ceil(100.0 * value - 1e-6) / 100.0;
}

double degrees(double angle_rad) {
  return angle_rad * 180.0 / std::numbers::pi;
}

std::string text_of(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
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

/// Stiffness of both springs at the lever: "0.0036 Nm/rad"
std::string turning_stiffness(double stiffness_N_per_m, const control::Lever& lever) {
  const double min = stiffness_N_per_m * lever.min_radius_m() * lever.min_radius_m();
  const double max = stiffness_N_per_m * lever.max_radius_m() * lever.max_radius_m();
  std::ostringstream out;
  out << min;
  if (!lever.is_constant()) out << " to " << max;
  out << " Nm/rad";
  return out.str();
}

/// How strongly the joint resists being turned. Even with a lever that depends on the angle, the
/// pull of both muscles does not change it while their moments are equal; a load makes them differ.
std::string stiffness_text(const JointSettings& joint, double stiffness_N_per_m) {
  const bool constant = joint.lever.is_constant();
  std::ostringstream out;
  out << stiffness_N_per_m << " N/m at the "
      << (joint.antagonist_lever_ratio == 1.0 ? "lever" : "agonist's lever")
      << (constant ? "" : " of 0°") << ", " << turning_stiffness(stiffness_N_per_m, joint.lever)
      << ", however much both pull: linear muscles" << (constant ? "" : " without a load");
  return out.str();
}

/// Both muscles' configurations describe the whole joint, so they should agree.
void advise_alike(const BoardSettings& board, const JointSettings& joint,
                  std::vector<std::string>& lines) {
  constexpr double max_ratio = 1.3;
  const auto configured = [&board](std::size_t place) {
    const ChannelSettings& c = board.channels[place];
    return c.file_muscle();
  };
  const control::PhysicalParameters first = configured(joint.agonist);
  const control::PhysicalParameters second = configured(joint.antagonist);
  for (const char* name : {"stiffness_N_per_m", "damping_Ns_per_m", "moving_mass_kg"}) {
    const auto range = std::ranges::find(control::physical_ranges, std::string_view(name),
                                         &control::PhysicalRange::name);
    const double of_first = first.*range->member;
    const double of_second = second.*range->member;
    const double same = of_first / (joint.antagonist_lever_ratio * joint.antagonist_lever_ratio);
    if (std::max(same, of_second) <= max_ratio * std::min(same, of_second)) continue;
    std::ostringstream line;
    line << "muscle." << name << " is " << of_first << " of channel " << joint.agonist + 1
         << " and " << of_second << " of channel " << joint.antagonist + 1
         << ": each describes the whole joint, and "
         << (joint.antagonist_lever_ratio == 1.0 ? std::string("they should be the same")
                                                 : "at their levers their ratio should be " +
                                                       text_of(of_first) + " to " + text_of(same));
    lines.push_back(line.str());
  }
}

/// The max pull of both muscles, and what they bear.
std::string max_pull_text(const JointLabel& label, double agonist_N, double antagonist_N) {
  std::ostringstream out;
  out << "the heat of this measured power adds at most " << up_to_hundredth(agonist_N) << " N and "
      << up_to_hundredth(antagonist_N) << " N to the pretension";
  if (label.max_pull_N) {
    out << " of " << label.pretension_N << " N: within max_pull_N = " << *label.max_pull_N;
  } else {
    out << "; max_pull_N, the max pull they bear, is not configured: nothing is refused";
  }
  return out.str();
}

/// The angle beyond which each muscle is slack without power, and the power that keeps it taut at
/// the end of its travel, whatever holds the joint there.
std::string slack_text(const BoardSettings& board, const JointSettings& joint) {
  if (!std::isfinite(joint.pretension_N)) return "unknown: pretension_N is not configured";
  std::ostringstream out;
  for (const std::size_t channel : {joint.agonist, joint.antagonist}) {
    const ChannelSettings& c = board.channels[channel];
    const double own_N_per_m = c.joint.stiffness_ratio * c.muscle.stiffness_N_per_m;
    const double end_m = c.supervision.max_travel_m;
    const bool first = channel == joint.agonist;
    out << (first ? "by the model, without power: the agonist " : "; the antagonist ");
    if (!(c.joint.cold_pull_N(end_m, c.muscle.stiffness_N_per_m) <= 0.0)) {
      out << "nowhere within its travel";
      continue;
    }
    const double from_m = c.joint.pretension_N / own_N_per_m;
    out << "from " << to_tenth(degrees(c.joint.angle_rad(from_m))) << "° on, taut at "
        << to_tenth(degrees(c.joint.angle_rad(end_m))) << "° with "
        << up_to_hundredth(ModelledPull(c.joint).taut_W(end_m, c.muscle)) << " W";
  }
  return out.str();
}

/// How far the air turns a joint whose muscles are not alike.
std::string air_text(const BoardSettings& board, const JointSettings& joint) {
  const double forward_m = air_shift_m(board.channels[joint.agonist]);
  const double back_m = air_shift_m(board.channels[joint.antagonist]);
  const double coldest_m = back_m / joint.antagonist_lever_ratio - forward_m;
  return arc(coldest_m, joint.lever) + " in the coldest air, if its zero was taken in the warmest";
}

}  // namespace

std::string describe_joint(const BoardConfig& config, std::size_t index) {
  const BoardSettings& board = config.settings;
  const JointSettings& joint = board.joints[index];
  const ChannelSettings& agonist = board.channels[joint.agonist];
  const ChannelSettings& antagonist = board.channels[joint.antagonist];
  const double gain_ratio = joint.gain_ratio(board.channels);
  const double back_rad = antagonist.joint.angle_rad(feasibility(antagonist, board).travel_m);
  std::ostringstream out;
  out << "joint " << index + 1 << ": " << config.joints[index].name << "\n"
      << "  muscles     agonist channel " << joint.agonist + 1 << ", antagonist channel "
      << joint.antagonist + 1 << "; lever of " << radius(joint.lever)
      << (joint.antagonist_lever_ratio == 1.0
              ? ""
              : ", the antagonist's of " + radius(joint.antagonist_lever()))
      << "\n"
      << "  range       held indefinitely by one muscle alone: from "
      << arc(joint.lever.arc_m(back_rad), joint.lever) << " to "
      << arc(feasibility(agonist, board).travel_m, joint.lever) << "\n"
      << "  rests       at " << air_text(board, joint) << "\n"
      << "  both pull   with " << to_tenth(joint.co_contraction_W) << " W and "
      << to_tenth(joint.co_contraction_W / gain_ratio)
      << " W while no effort is asked for; each muscle contributes half of an effort\n"
      << "              at most with " << to_tenth(joint.max_co_contraction_W) << " W and "
      << to_tenth(joint.max_co_contraction_W / gain_ratio) << " W\n              "
      << max_pull_text(config.joints[index], hottest_pull_N(agonist, joint.max_co_contraction_W),
                       hottest_pull_N(antagonist, joint.max_co_contraction_W / gain_ratio))
      << "\n"
      << "  stiffness   " << stiffness_text(joint, agonist.muscle.stiffness_N_per_m) << "\n"
      << "  slack       " << slack_text(board, joint) << "\n";
  return out.str();
}

std::string describe_turned(const BoardConfig& config, std::size_t channel) {
  const ChannelSettings& c = config.settings.channels[channel];
  const control::Lever& lever = c.joint.lever;
  const std::string& joint = config.labels[channel].joint;
  return (joint.empty() ? "turned" : joint + ", turned") +
         (c.joint.weighs() ? " against gravity" : " against a spring") + "; lever of " +
         radius(lever) + "; held indefinitely up to " +
         arc(feasibility(c, config.settings).travel_m, lever) + "; " +
         (c.joint.weighs() ? turning_stiffness(c.muscle.stiffness_N_per_m,
                                               control::Lever(lever.zero_radius_m())) +
                                 " at 0°"
                           : turning_stiffness(c.muscle.stiffness_N_per_m, lever));
}

std::vector<std::string> joint_advice(const BoardConfig& config, std::size_t index) {
  const JointSettings& joint = config.settings.joints[index];
  const JointLabel& label = config.joints[index];
  std::vector<std::string> lines;
  advise_alike(config.settings, joint, lines);
  if (!label.max_pull_N) return lines;
  for (const std::size_t place : {joint.agonist, joint.antagonist}) {
    const ChannelSettings& channel = config.settings.channels[place];
    const double lever_ratio = place == joint.antagonist ? joint.antagonist_lever_ratio : 1.0;
    const double pull_N =
        label.pretension_N / lever_ratio + hottest_pull_N(channel, channel.limiter.max_W);
    if (pull_N <= *label.max_pull_N) continue;
    std::ostringstream line;
    line << "if something blocks it, channel " << place + 1 << " alone may pull with up to "
         << up_to_hundredth(pull_N) << " N at its max_W = " << channel.limiter.max_W
         << ", more than max_pull_N = " << *label.max_pull_N;
    lines.push_back(line.str());
  }
  return lines;
}

}  // namespace supercoil::config
