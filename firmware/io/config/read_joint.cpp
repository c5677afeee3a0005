#include "config/read_joint.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>

namespace supercoil::config {

namespace {

enum class OpposedBy { muscle, spring, gravity };
constexpr control::Names<OpposedBy, 3> opposed_by_names{{{"muscle", OpposedBy::muscle},
                                                         {"spring", OpposedBy::spring},
                                                         {"gravity", OpposedBy::gravity}}};

/// Empty: it is not one of these names, which has been reported.
std::optional<OpposedBy> read_opposed_by(Section& section) {
  constexpr const char* key = "opposed_by";
  const OpposedBy read = section.choice(key, OpposedBy::muscle, opposed_by_names);
  const bool as_read =
      !section.has(key) || (*section.table())[key].value<std::string>() ==
                               std::string(control::name_of(opposed_by_names, read));
  return as_read ? std::optional(read) : std::nullopt;
}

constexpr double usual_co_contraction_ratio = 0.2;  ///< of what both heaters can give

/// In watts of the agonist.
void read_co_contraction(Section& section, const BoardSettings& board, JointSettings& joint) {
  const double both_W = feasible_co_contraction_W(board, joint);
  joint.co_contraction_W = 0.0;
  // What a channel lacks is reported there.
  if (!(both_W > 0.0)) return;
  joint.max_co_contraction_W = section.number(
      "max_co_contraction_W", JointSettings::default_limit_ratio * both_W, {0.0, both_W});
  joint.co_contraction_W = section.number(
      "co_contraction_W", std::min(usual_co_contraction_ratio * both_W, joint.max_co_contraction_W),
      {0.0, both_W});
  if (joint.co_contraction_W <= joint.max_co_contraction_W) return;
  std::ostringstream message;
  message << "must not exceed max_co_contraction_W, which is " << joint.max_co_contraction_W;
  section.wrong("co_contraction_W", message.str());
  joint.co_contraction_W = joint.max_co_contraction_W;
}

}  // namespace

JointReader::JointReader(std::vector<Section> sections, std::size_t channels) {
  for (Section& section : sections)
    joints_.push_back({std::move(section)});
  for (Read& joint : joints_)
    read(joint, channels);
}

std::optional<std::size_t> JointReader::read_place(Section& section, const char* key,
                                                   std::size_t channels) {
  const auto max_number = static_cast<std::int64_t>(std::max<std::size_t>(1, channels));
  const std::int64_t number = section.required_integer(key, 1, max_number);
  // Missing, or reported as wrong.
  if (!section.has(key) || (*section.table())[key].value<std::int64_t>() != number)
    return std::nullopt;
  const auto place = static_cast<std::size_t>(number - 1);
  if (std::find(taken_.begin(), taken_.end(), place) != taken_.end()) {
    section.wrong(key, "is a channel that is already in a joint");
    return std::nullopt;
  }
  taken_.push_back(place);
  return place;
}

void JointReader::read(Read& joint, std::size_t channels) {
  Section& section = joint.section;
  const auto opposed_by = read_opposed_by(section);
  const bool is_alone = opposed_by && opposed_by != OpposedBy::muscle;
  const auto agonist = read_place(section, "agonist", channels);
  // With an unknown opposed_by, the joint may have an antagonist or not.
  const bool has_antagonist = opposed_by ? !is_alone : section.has("antagonist");
  const auto antagonist =
      has_antagonist ? read_place(section, "antagonist", channels) : std::nullopt;
  joint.lever = read_lever(section, lever_range_m, std::nullopt);
  if (is_alone) {
    joint.alone = {.direction = 1, .lever = joint.lever};
    if (opposed_by == OpposedBy::gravity) read_weight(section, joint.alone);
    joint.travel = read_joint_travel(section, joint.lever, std::nullopt);
    if (agonist && *agonist < channels) joint.turned_by = agonist;
    is_wrong_ = is_wrong_ || !joint.turned_by || (section.has("range_deg") && !joint.travel);
    return;
  }
  const double ratio = read_antagonist_lever_ratio(section, joint.lever);
  joint.travel = read_joint_travel(section, joint.lever, joint.lever.scaled(ratio));
  if (agonist && antagonist && std::max(*agonist, *antagonist) < channels) {
    joint.pair = JointSettings{.agonist = *agonist,
                               .antagonist = *antagonist,
                               .lever = joint.lever,
                               .antagonist_lever_ratio = ratio};
  }
  is_wrong_ = is_wrong_ || !joint.pair || (section.has("range_deg") && !joint.travel);
}

std::optional<std::size_t> JointReader::agonist_of(std::size_t channel) const {
  for (const Read& joint : joints_) {
    if (joint.pair && joint.pair->antagonist == channel) return joint.pair->agonist;
  }
  return std::nullopt;
}

PlaceInJoint JointReader::place_of(std::size_t channel) const {
  for (const Read& joint : joints_) {
    if (joint.turned_by == channel) return joint.alone;
    const PlaceInJoint place = joint.pair ? joint.pair->place_of(channel) : PlaceInJoint();
    if (place.turns()) return place;
  }
  return {};
}

std::optional<double> JointReader::max_travel_m(std::size_t channel) const {
  for (const Read& joint : joints_) {
    if (!joint.travel) continue;
    if (joint.turned_by == channel) return joint.travel->agonist_m;
    if (!joint.pair) continue;
    if (joint.pair->agonist == channel) return joint.travel->agonist_m;
    if (joint.pair->antagonist == channel) return joint.travel->antagonist_m;
  }
  return std::nullopt;
}

void JointReader::finish(BoardConfig& config) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    Read& joint = joints_[i];
    Section& section = joint.section;
    if (joint.turned_by) {
      config.labels[*joint.turned_by].joint = section.text("name", "");
      refuse_weight(section, config.settings.channels[*joint.turned_by], *joint.turned_by + 1);
      section.finish();
      continue;
    }
    const std::string name = section.text("name", "joint " + std::to_string(i + 1));
    section.allow({"co_contraction_W", "max_co_contraction_W", "max_pull_N", "pretension_N",
                   "stiffness_ratio"});
    if (joint.pair) {
      JointLabel label;
      label.name = name;
      read_co_contraction(section, config.settings, *joint.pair);
      read_pull(section, config.settings, *joint.pair, label);
      add_joint(config.settings, *joint.pair);
      config.joints.push_back(std::move(label));
    }
    section.finish();
  }
}

}  // namespace supercoil::config
