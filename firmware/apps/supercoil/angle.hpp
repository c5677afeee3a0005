// Angles of a joint in commands of a person: "20deg".
#pragma once

#include <optional>
#include <string_view>

#include "loop/known_muscle.hpp"

namespace supercoil::operating {

/// The number of "20deg"; empty: it is no angle.
std::optional<double> degrees_of(std::string_view text);

/// The arc at the joint's lever, which a board tells of a muscle; NaN: it is in no joint.
double metres_per_degree(const KnownMuscle& muscle);

}  // namespace supercoil::operating
