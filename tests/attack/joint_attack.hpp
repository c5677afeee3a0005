// What an attack does to a joint of two muscles, and what the joint is doing meanwhile.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "attack/group_attack.hpp"

namespace supercoil::test {

struct JointAttack : GroupAttack {
  std::array<MuscleHarm, 2> muscles{};  ///< 0: the agonist
  double position_gain = 1.0;  ///< of the sensor; 0: its magnet came off; < 0: mounted upside down
  bool jammed = false;         ///< the joint does not turn any more
  bool swapped_heaters = false;
};

std::vector<JointAttack> all_joint_attacks();

/// What the joint is asked for from the attack on.
enum class JointActivity { disarmed, hold, sine, pull, press, rearm, identify, alone };
inline constexpr std::array<std::string_view, 8> joint_activity_names{
    "disarmed", "hold", "sine", "pull", "press", "re-arm", "identify", "alone"};

}  // namespace supercoil::test
