#include "config/read_lever.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace supercoil::config {

namespace {

constexpr const char* lever_key = "lever_m";
constexpr const char* range_key = "lever_range_deg";
constexpr double rad_per_deg = std::numbers::pi / 180.0;
constexpr double max_angle_deg = 180.0;

}  // namespace

control::Lever read_lever(Section& section, Range radius_m, std::optional<double> fallback_m) {
  const bool table = section.has(lever_key) && section.table() != nullptr &&
                     (*section.table())[lever_key].is_array();
  if (!table) {
    if (section.has(range_key)) {
      section.wrong(range_key, "needs lever_m to be a list");
    }
    section.allow({range_key});
    const double lever_m = fallback_m ? section.number(lever_key, *fallback_m, radius_m)
                                      : section.required_number(lever_key, radius_m);
    // What is missing or wrong has been reported.
    return control::Lever(std::isfinite(lever_m) ? lever_m : radius_m.max);
  }
  const auto radii_m = section.numbers(lever_key, {radius_m.max, radius_m.max}, radius_m, 2,
                                       control::Lever::max_points);
  if (!section.has(range_key)) {
    section.wrong(lever_key, "needs lever_range_deg, the angles of its first and its last lever");
    return control::Lever(radii_m.front());
  }
  const auto range_deg = section.required_numbers(range_key, {-max_angle_deg, max_angle_deg}, 2, 2);
  if (range_deg.empty()) return control::Lever(radii_m.front());  // reported
  if (!(range_deg[0] <= 0.0 && range_deg[1] >= 0.0 && range_deg[0] < range_deg[1])) {
    section.wrong(range_key, "must be two angles, with 0 between them or equal to one of them");
    return control::Lever(radii_m.front());
  }
  return {rad_per_deg * range_deg[0], rad_per_deg * range_deg[1], radii_m};
}

double read_antagonist_lever_ratio(Section& section, const control::Lever& agonist) {
  const double lever_m = agonist.zero_radius_m();
  return section.number("antagonist_lever_m", lever_m, lever_range_m) / lever_m;
}

double metres_per_degree(const control::Lever& lever) {
  return rad_per_deg * lever.zero_radius_m();
}

std::optional<JointTravel> read_joint_travel(Section& section, const control::Lever& agonist,
                                             const std::optional<control::Lever>& antagonist) {
  constexpr const char* key = "range_deg";
  const auto range_deg = section.numbers(key, {}, {-max_angle_deg, max_angle_deg}, 2, 2);
  if (range_deg.empty()) return std::nullopt;
  JointTravel travel{agonist.arc_m(rad_per_deg * range_deg[1]), 0.0};
  if (antagonist) travel.antagonist_m = -antagonist->arc_m(rad_per_deg * range_deg[0]);
  const bool turns_back =
      antagonist ? travel.antagonist_m >= limits_of_travel_m.min : range_deg[0] == 0.0;
  if (turns_back && travel.agonist_m >= limits_of_travel_m.min) return travel;
  section.wrong(key, antagonist ? "must be two angles, the first below 0 and the second above it"
                                : "must be two angles, the first 0, where the one muscle is cold, "
                                  "and the second above it");
  return std::nullopt;
}

}  // namespace supercoil::config
