#include "apps/supercoil/setup/file_joint.hpp"

#include <cmath>
#include <numbers>

#include "apps/supercoil/setup/channel_steps.hpp"
#include "config/read_lever.hpp"
#include "config/toml_file.hpp"
#include "text/number_text.hpp"

namespace supercoil::operating {

namespace {

constexpr double deg_per_rad = 180.0 / std::numbers::pi;
/// Angles are written in whole hundredths of a degree.
constexpr double angle_step_deg = 0.01;
constexpr int angle_digits = 6;
constexpr const char* range_key = "range_deg";

FileJoint read_joint(const toml::table& table, std::size_t place, bool agonist) {
  config::Diagnostics ignored("");
  config::Section section(&table, "joint", ignored);
  const control::Lever lever = config::read_lever(section, config::lever_range_m, std::nullopt);
  std::optional<control::Lever> antagonist;
  if (table.contains("antagonist"))
    antagonist = lever.scaled(config::read_antagonist_lever_ratio(section, lever));
  FileJoint joint{place, agonist, antagonist.has_value(), agonist ? lever : antagonist.value(),
                  std::nullopt};
  const auto first = table[range_key][0].value<double>();
  const auto last = table[range_key][1].value<double>();
  if (first && last && config::read_joint_travel(section, lever, antagonist))
    joint.range_deg = {*first, *last};
  return joint;
}

}  // namespace

double FileJoint::max_travel_m() const {
  if (!range_deg) return INFINITY;
  return agonist ? lever.arc_m((*range_deg)[1] / deg_per_rad)
                 : -lever.arc_m((*range_deg)[0] / deg_per_rad);
}

std::string FileJoint::range_literal(double travel_m) const {
  const double angle_deg = deg_per_rad * lever.angle_rad(agonist ? travel_m : -travel_m);
  const double written_deg = angle_step_deg * std::trunc(angle_deg / angle_step_deg);
  std::array<double, 2> range = range_deg.value();
  range.at(agonist ? 1 : 0) = written_deg;
  return "[" + number_text(range[0], angle_digits) + ", " + number_text(range[1], angle_digits) +
         "]";
}

std::optional<FileJoint> joint_in_file(const std::string& text, int channel) {
  const toml::table document = toml::parse(text);
  const toml::array* joints = document["joint"].as_array();
  if (joints == nullptr) return std::nullopt;
  for (std::size_t i = 0; i < joints->size(); ++i) {
    const toml::table* joint = joints->get(i)->as_table();
    if (joint == nullptr) continue;
    const auto is = [&](const char* key) { return (*joint)[key].value<int>() == channel; };
    if (is("agonist") || is("antagonist")) return read_joint(*joint, i, is("agonist"));
  }
  return std::nullopt;
}

std::optional<Entry> travel_entry(const std::string& text, int channel, double travel_m,
                                  const std::string& literal, const std::string& reason) {
  const auto joint = joint_in_file(text, channel);
  if (!joint || !joint->range_deg) return Entry{travel_key, literal, reason, std::nullopt};
  if (travel_m >= joint->max_travel_m()) return std::nullopt;
  return Entry{range_key, joint->range_literal(travel_m), reason, joint->place};
}

}  // namespace supercoil::operating
