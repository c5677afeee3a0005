#include "config/read_joint.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>

namespace supercoil::config {

namespace {

enum class OpposedBy { muscle, spring };
constexpr control::Names<OpposedBy, 2> opposed_by_names{
    {{"muscle", OpposedBy::muscle}, {"spring", OpposedBy::spring}}};

constexpr double usual_co_contraction_ratio = 0.2;  ///< of what both heaters can give

/// In watts of the agonist.
void read_co_contraction(Section& section, const BoardSettings& board, JointSettings& joint) {
  const double both_W = feasible_co_contraction_W(board, joint);
  joint.co_contraction_W = 0.0;
  // What a channel lacks is told there.
  if (!(both_W > 0.0)) return;
  joint.max_co_contraction_W = section.number(
      "max_co_contraction_W", JointSettings::usual_limit_ratio * both_W, {0.0, both_W});
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

JointReader::JointReader(std::vector<Section> sections, std::size_t channels)
    : sections_(std::move(sections)) {
  read_places(channels);
}

std::optional<std::size_t> JointReader::read_place(Section& section, const char* key,
                                                   std::size_t channels) {
  const auto most = static_cast<std::int64_t>(std::max<std::size_t>(1, channels));
  const std::int64_t number = section.required_integer(key, 1, most);
  // Missing, or said to be wrong.
  if (!section.has(key) || (*section.table())[key].value<std::int64_t>() != number)
    return std::nullopt;
  const auto place = static_cast<std::size_t>(number - 1);
  if (std::find(taken_.begin(), taken_.end(), place) != taken_.end()) {
    section.wrong(key, "is a channel that pulls in a joint already");
    return std::nullopt;
  }
  taken_.push_back(place);
  return place;
}

/// Its muscle's travel is a limit of its channel, as of a muscle alone.
void JointReader::read_turned(Section& section, std::size_t channels) {
  const auto agonist = read_place(section, "agonist", channels);
  const control::Lever lever = read_lever(section, lever_range_m, std::nullopt);
  if (agonist && *agonist < channels) turned_.back() = Turned{*agonist, lever};
}

void JointReader::read_places(std::size_t channels) {
  for (Section& section : sections_) {
    turned_.emplace_back();
    if (section.choice("opposed_by", OpposedBy::muscle, opposed_by_names) == OpposedBy::spring) {
      travels_.emplace_back();
      joints_.emplace_back();
      read_turned(section, channels);
      continue;
    }
    const auto agonist = read_place(section, "agonist", channels);
    const auto antagonist = read_place(section, "antagonist", channels);
    const control::Lever lever = read_lever(section, lever_range_m, std::nullopt);
    travels_.push_back(read_joint_travel(section, lever));
    has_wrong_range_ = has_wrong_range_ || (section.has("range_deg") && !travels_.back());
    joints_.emplace_back();
    if (!agonist || !antagonist || std::max(*agonist, *antagonist) >= channels) continue;
    joints_.back() = JointSettings{.agonist = *agonist, .antagonist = *antagonist, .lever = lever};
  }
}

std::optional<std::size_t> JointReader::agonist_of(std::size_t channel) const {
  for (const auto& joint : joints_) {
    if (joint && joint->antagonist == channel) return joint->agonist;
  }
  return std::nullopt;
}

bool JointReader::is_wrong() const {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (!joints_[i] && !turned_[i]) return true;
  }
  return has_wrong_range_;
}

PlaceInJoint JointReader::place_of(std::size_t channel) const {
  for (const auto& joint : joints_) {
    if (joint && joint->place_of(channel).turns()) return joint->place_of(channel);
  }
  for (const auto& turned : turned_) {
    if (turned && turned->channel == channel) return {1, turned->lever, NAN};
  }
  return {};
}

std::optional<double> JointReader::max_travel_m(std::size_t channel) const {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const int direction = joints_[i] ? joints_[i]->place_of(channel).direction : 0;
    if (direction == 0 || !travels_[i]) continue;
    return direction > 0 ? travels_[i]->agonist_m : travels_[i]->antagonist_m;
  }
  return std::nullopt;
}

void JointReader::finish(BoardConfig& config) {
  for (std::size_t i = 0; i < sections_.size(); ++i) {
    Section& section = sections_[i];
    if (turned_[i]) {
      config.labels[turned_[i]->channel].joint = section.text("name", "");
      section.finish();
      continue;
    }
    const std::string name = section.text("name", "joint " + std::to_string(i + 1));
    section.allow({"co_contraction_W", "max_co_contraction_W", "max_pull_N", "pretension_N"});
    if (joints_[i]) {
      JointLabel label;
      label.name = name;
      read_co_contraction(section, config.settings, *joints_[i]);
      read_pull(section, config.settings, *joints_[i], label);
      add_joint(config.settings, *joints_[i]);
      config.joints.push_back(std::move(label));
    }
    section.finish();
  }
}

}  // namespace supercoil::config
