// lever_m of a joint: a number, or several of them over a range of angles.
#pragma once

#include <optional>

#include "supercoil/control/joint/lever.hpp"

#include "config/section.hpp"

namespace supercoil::config {

/// Allowed lever of a real joint.
inline constexpr Range lever_range_m{1e-4, 1.0};
/// Allowed weight_Nm and hangs_at_deg of an arm.
inline constexpr Range weight_range_Nm{1e-6, 100.0};
inline constexpr Range hangs_at_range_deg{-179.0, 0.0};
/// Allowed limits.max_travel_m.
inline constexpr Range limits_of_travel_m{1e-5, 10.0};

/// Reads lever_m and lever_range_deg. Without lever_m, uses fallback_m or, if that is empty,
/// reports lever_m as missing.
control::Lever read_lever(Section& section, Range radius_m, std::optional<double> fallback_m);

/// Reads antagonist_lever_m, over the agonist's lever at the angle 0; 1 if it is absent.
double read_antagonist_lever_ratio(Section& section, const control::Lever& agonist);

/// The arc of one degree of a joint's angle sensor, at the lever of the angle 0.
double metres_per_degree(const control::Lever& lever);

/// How far each muscle may contract, as arcs at its lever.
struct JointTravel {
  double agonist_m;
  double antagonist_m;  ///< 0: there is none
};
/// Reads range_deg: how far the joint may turn each way. antagonist: empty if no muscle draws it
/// back beyond 0. Empty: the key is absent or wrong.
std::optional<JointTravel> read_joint_travel(Section& section, const control::Lever& agonist,
                                             const std::optional<control::Lever>& antagonist);

}  // namespace supercoil::config
