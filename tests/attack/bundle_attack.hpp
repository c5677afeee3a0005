// What is done to a bundle of three muscles, while it does what.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "attack/attack.hpp"

namespace supercoil::test {

/// What happens to one muscle of a bundle, beside a lost cooling.
struct BundledHarm {
  double current_gain = 1.0;  ///< what its sense reads, over the truth
  double cooling_ratio = worst_configured_cooling;
  double switch_leak_ratio = 0.0;
  bool off = false;  ///< its anchor: heat does not move the load any more
};

struct BundleAttack {
  std::string name;
  std::array<BundledHarm, 3> muscles{};  ///< 0: the first, which leads
  double supply_gain = 1.0;
  double air_C = 30.0;
  bool swapped_currents = false;  ///< of the last two
  bool from_start = false;
  /// The board knows the bundle, and its senses were compared with a meter.
  bool identified = false;
  std::string_view guard;      ///< as Attack's
  std::string_view blindness;  ///< likewise
};

std::vector<BundleAttack> all_bundle_attacks();

/// What the bundle is asked for from the attack on.
enum class BundleActivity { disarmed, hold, power, press, rearm, identify, calibrate };
inline constexpr std::array<std::string_view, 7> bundle_activity_names{
    "disarmed", "hold", "power", "press", "re-arm", "identify", "calibrate"};

}  // namespace supercoil::test
