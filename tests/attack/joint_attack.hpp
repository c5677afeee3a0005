// What is done to a joint of two muscles, while it does what.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "attack/attack.hpp"

namespace supercoil::test {

/// What happens to one muscle of a joint, beside a lost cooling.
struct MuscleHarm {
  double current_gain = 1.0;  ///< what its sense reads, over the truth
  double cooling_ratio = worst_configured_cooling;
  double switch_leak_ratio = 0.0;
  bool torn = false;
  double slack_m = 0.0;
};

struct JointAttack {
  std::string name;
  std::array<MuscleHarm, 2> muscles{};  ///< 0: the agonist
  double supply_gain = 1.0;
  double air_C = 30.0;
  double position_gain = 1.0;  ///< of the sensor; 0: its magnet came off; < 0: mounted upside down
  bool jammed = false;         ///< the joint does not turn any more
  bool swapped_heaters = false;
  bool swapped_currents = false;
  bool from_start = false;
  /// The board knows both muscles, and its senses were compared with a meter.
  bool identified = false;
  std::string_view guard;      ///< as Attack's
  std::string_view blindness;  ///< likewise
};

std::vector<JointAttack> all_joint_attacks();

/// What the joint is asked for from the attack on.
enum class JointActivity { disarmed, hold, sine, pull, press, rearm, identify, alone };
inline constexpr std::array<std::string_view, 8> joint_activity_names{
    "disarmed", "hold", "sine", "pull", "press", "re-arm", "identify", "alone"};

}  // namespace supercoil::test
