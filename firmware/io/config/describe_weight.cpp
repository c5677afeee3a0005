// What an arm's weight demands of the muscle that lifts it, in words.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "config/describe.hpp"
#include "loop/hanging_arm.hpp"
#include "text/number_text.hpp"

namespace supercoil::config {

namespace {

std::string in_deg(const ChannelSettings& c, double position_m) {
  return number_text(c.joint.angle_rad(position_m) * 180.0 / std::numbers::pi, 3) + "°";
}

}  // namespace

std::string describe_weight(const ChannelSettings& c) {
  constexpr int parts = 4;
  const HangingArm arm(c.joint, c.muscle);
  const double end_m = arm.tips_over_m(c.supervision.max_travel_m);
  std::string line =
      "the weight pulls the cold muscle with " + number_text(arm.pull_N(0.0), 3) + " N; held";
  double max_N = 0.0;
  for (int i = 1; i <= parts; ++i) {
    const double at_m = end_m * i / parts;
    line += (i == 1 ? " at " : ", ") + in_deg(c, at_m) + " with " +
            number_text(arm.power_W(at_m), 3) + " W";
    max_N = std::max(max_N, arm.pull_N(at_m));
  }
  line += "; pulls with up to " + number_text(std::max(max_N, arm.pull_N(0.0)), 3) + " N";
  return line;
}

void advise_weight(const ChannelSettings& c, std::vector<std::string>& lines) {
  if (!c.joint.weighs()) return;
  const double max_m = c.supervision.max_travel_m;
  const double end_m = HangingArm(c.joint, c.muscle).tips_over_m(max_m);
  if (end_m >= max_m) return;
  lines.push_back("above " + in_deg(c, end_m) +
                  " the arm tips over: the weight's pull falls faster than the muscle's, and no "
                  "power holds it there; end the travel, which goes up to " +
                  in_deg(c, max_m) + ", before that angle");
}

}  // namespace supercoil::config
