// What attacks on several muscles that move together have in common.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "attack/attack.hpp"

namespace supercoil::test {

/// What happens to one muscle, besides lost cooling.
struct MuscleHarm {
  double current_gain = 1.0;  ///< what its sense reads, over the truth
  double cooling_ratio = worst_configured_cooling;
  double switch_leak_ratio = 0.0;
  bool torn = false;
  double slack_m = 0.0;
  bool off = false;  ///< its anchor is off: heat no longer moves the load, its spring still does
};

struct GroupAttack {
  std::string name;
  double supply_gain = 1.0;
  double air_C = 30.0;
  bool swapped_currents = false;
  bool from_start = false;
  /// The board knows the muscles, and its senses were compared with a meter.
  bool identified = false;
  std::string_view guard;      ///< as Attack's
  std::string_view blindness;  ///< likewise
};

/// A muscle that is attacked by itself.
struct NamedMuscle {
  std::size_t place;
  std::string_view name;
};
using NamedMuscles = std::span<const NamedMuscle>;

// Each AnyAttack is a GroupAttack with `muscles`, a MuscleHarm for each.

template <class AnyAttack>
void add_to_each(std::vector<AnyAttack>& attacks, NamedMuscles named, const std::string& what,
                 const MuscleHarm& harm, const AnyAttack& other = {}) {
  for (const NamedMuscle& muscle : named) {
    AnyAttack a = other;
    a.name = std::string(muscle.name) + ": " + what;
    a.muscles.at(muscle.place) = harm;
    attacks.push_back(a);
  }
}

/// Adds an attack that is there from the start.
template <class AnyAttack>
AnyAttack& add_from_start(std::vector<AnyAttack>& attacks, const std::string& name) {
  AnyAttack& a = attacks.emplace_back();
  a.name = name;
  a.from_start = true;
  return a;
}

template <class AnyAttack>
void add_lying_senses(std::vector<AnyAttack>& attacks, NamedMuscles named) {
  AnyAttack from_start;
  from_start.from_start = true;
  for (const double gain : {0.64, 0.78, 1.3, 1.5}) {
    add_to_each(attacks, named, "current × " + text_of(gain), {.current_gain = gain}, from_start);
  }
  for (const double gain : {0.78, 0.9, 1.3})
    add_from_start(attacks, "supply × " + text_of(gain)).supply_gain = gain;
}

/// An attack with this cooling; guarded and blind when that is worse than configured.
template <class AnyAttack>
AnyAttack cooled_by(double ratio) {
  AnyAttack a;
  if (ratio >= worst_configured_cooling) return a;
  a.guard = "thermal fuse";
  a.blindness = worse_cooling;
  return a;
}

template <class AnyAttack>
void add_leaks(std::vector<AnyAttack>& attacks, NamedMuscles named) {
  for (const double percent : {1.0, 5.0, 20.0, 100.0}) {
    AnyAttack other;
    if (percent <= 5.0) other.blindness = leak_as_noise;
    add_to_each(attacks, named, leak_text(percent), {.switch_leak_ratio = 0.01 * percent}, other);
  }
}

template <class AnyAttack>
void add_hot_air(std::vector<AnyAttack>& attacks) {
  AnyAttack& air = add_from_start(attacks, "air at 60 °C");
  air.air_C = 60.0;
  air.blindness = warmer_air;
}

/// Repeats on identified muscles the attacks that the board sees least, and those of `also`.
template <class AnyAttack>
void add_identified(
    std::vector<AnyAttack>& attacks,
    bool (*also)(const AnyAttack&) = [](const AnyAttack&) { return false; }) {
  const std::vector<AnyAttack> others = attacks;
  for (AnyAttack a : others) {
    if (a.blindness.empty() && !also(a)) continue;
    a.name = "identified, " + a.name;
    a.identified = true;
    if (a.air_C >= 60.0) a.guard = "thermal fuse";
    attacks.push_back(a);
  }
}

}  // namespace supercoil::test
