// What an attack does to a bundle of three muscles, and what the bundle is doing meanwhile.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "attack/group_attack.hpp"

namespace supercoil::test {

/// swapped_currents: of the last two.
struct BundleAttack : GroupAttack {
  std::array<MuscleHarm, 3> muscles{};  ///< 0: the first, which leads
};

std::vector<BundleAttack> all_bundle_attacks();

/// What the bundle is asked for from the attack on.
enum class BundleActivity { disarmed, hold, power, press, rearm, identify, calibrate };
inline constexpr std::array<std::string_view, 7> bundle_activity_names{
    "disarmed", "hold", "power", "press", "re-arm", "identify", "calibrate"};

}  // namespace supercoil::test
