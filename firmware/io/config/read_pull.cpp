// What a joint's muscles bear, and what they may be made to pull with.
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "config/read_joint.hpp"
#include "loop/feasibility.hpp"

namespace supercoil::config {

namespace {

constexpr Range pull_range_N{1e-3, 1e4};

/// One of a joint's two muscles, at the max co-contraction.
struct Puller {
  std::size_t channel;  ///< from 0
  double pretension_N;
  double heat_N;           ///< that heat may add to it
  double agonist_W_per_N;  ///< co-contraction per newton of heat_N, if temperature allows it
  double power_W;          ///< its own power
};

Puller puller(const BoardSettings& board, std::size_t channel, double pretension_N,
              double co_contraction_W, double ratio) {
  const ChannelSettings& c = board.channels[channel];
  const double W_per_N = c.thermal.bounds.min_transfer_W_per_K / c.muscle.force_per_kelvin_N_per_K;
  const double power_W = co_contraction_W / ratio;
  return {channel, pretension_N, hottest_pull_N(c, power_W), ratio * W_per_N, power_W};
}

/// So that a printed value can be configured as it is.
double rounded_down(double value) {
  return std::floor(1e3 * value) / 1e3;
}
double rounded_up(double value) {
  return std::ceil(1e3 * value) / 1e3;
}

std::string excess(const Puller& p, const JointSettings& joint, double allowed_W) {
  std::ostringstream message;
  message << "is less than channel " << p.channel + 1 << " may pull with: a pretension of "
          << p.pretension_N << " N, and " << rounded_up(p.heat_N)
          << " N from the heat of max_co_contraction_W = " << joint.max_co_contraction_W
          << ", which is " << rounded_up(p.power_W)
          << " W there; max_co_contraction_W must be 0 to " << rounded_down(allowed_W)
          << ", or max_pull_N at least " << rounded_up(p.pretension_N + p.heat_N);
  return message.str();
}

}  // namespace

void read_stiffness_ratio(Section& section, JointSettings& joint) {
  constexpr const char* key = "stiffness_ratio";
  const auto ratios = section.numbers(key, {}, {0.0, 1.0}, 2, 2);
  if (ratios.empty()) return;
  constexpr double rounding = 1e-9;
  if (ratios[0] + ratios[1] > 1.0 + rounding)
    return section.wrong(key, "must not exceed 1 in total: a spring has the rest");
  joint.stiffness_ratio = {ratios[0], ratios[1]};
}

void read_pull(Section& section, const BoardSettings& board, JointSettings& joint,
               JointLabel& label) {
  label.pretension_N = section.number("pretension_N", 0.0, {0.0, pull_range_N.max});
  if (section.has("pretension_N")) joint.pretension_N = label.pretension_N;
  read_stiffness_ratio(section, joint);
  label.max_pull_N = section.optional_number("max_pull_N", pull_range_N);
  if (!label.max_pull_N) return;
  const double antagonist_N = label.pretension_N / joint.antagonist_lever_ratio;
  const double cold_N = std::max(label.pretension_N, antagonist_N);
  if (*label.max_pull_N < cold_N) {
    std::ostringstream message;
    message << "must not be less than the pretension, which is " << cold_N << " N";
    return section.wrong("max_pull_N", message.str());
  }
  const double ratio = joint.gain_ratio(board.channels);
  const double max_W = joint.max_co_contraction_W;
  const std::array<Puller, 2> both{puller(board, joint.agonist, label.pretension_N, max_W, 1.0),
                                   puller(board, joint.antagonist, antagonist_N, max_W, ratio)};
  const auto pull_N = [](const Puller& p) { return p.pretension_N + p.heat_N; };
  const Puller& hardest = pull_N(both[0]) < pull_N(both[1]) ? both[1] : both[0];
  // What a channel lacks is reported there.
  if (!std::isfinite(max_W) || !(pull_N(hardest) > *label.max_pull_N)) return;
  double allowed_W = max_W;
  for (const Puller& p : both)
    allowed_W = std::min(allowed_W, (*label.max_pull_N - p.pretension_N) * p.agonist_W_per_N);
  section.wrong("max_pull_N", excess(hardest, joint, allowed_W));
}

}  // namespace supercoil::config
