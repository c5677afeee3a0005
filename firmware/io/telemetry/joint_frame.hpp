// The message Joint: what a joint's node reports about the joint and its two heaters.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "supercoil/control/joint/lever.hpp"
#include "supercoil/hal/can_bus.hpp"

#include "can/nodes.hpp"
#include "loop/row.hpp"

namespace supercoil::telemetry {

/// What a frame carries besides the angle, numbered as in Joint.part.
enum class JointPart : std::uint8_t {
  motion,
  effort,
  agonist_heat,
  agonist_power,
  antagonist_heat,
  antagonist_power,
};
inline constexpr std::array<std::string_view, 6> joint_part_names{
    "motion", "effort", "agonist_heat", "agonist_power", "antagonist_heat", "antagonist_power"};

/// A spring or gravity instead of an antagonist has no heater to report.
constexpr std::uint8_t joint_parts(bool has_antagonist) {
  return static_cast<std::uint8_t>(has_antagonist ? JointPart::antagonist_power
                                                  : JointPart::agonist_power) +
         1;
}

/// lever: of the agonist. antagonist: null if there is none, or no row of it yet.
hal::CanFrame joint(can::Node node, JointPart part, const control::Lever& lever, const Row& agonist,
                    const Row* antagonist);

}  // namespace supercoil::telemetry
