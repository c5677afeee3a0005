// lever_m of a joint: a number, or several of them over a range of angles.
#pragma once

#include <optional>

#include "supercoil/control/joint/lever.hpp"

#include "config/section.hpp"

namespace supercoil::config {

/// Of a real joint's lever.
inline constexpr Range lever_range_m{1e-4, 1.0};

/// Keys lever_m and lever_range_deg. Where lever_m is absent it is fallback_m, or is said to be
/// missing if that is empty.
control::Lever read_lever(Section& section, Range radius_m, std::optional<double> fallback_m);

}  // namespace supercoil::config
