#include <cstdio>

#include "attack/attack.hpp"

namespace supercoil::test {

namespace {

void add_lying_senses(std::vector<Attack>& attacks) {
  constexpr std::array<double, 8> gains{0.5, 0.64, 0.78, 0.9, 1.1, 1.3, 1.4, 1.5};
  const auto add = [&](double current, double supply) {
    Attack a;
    if (current != 1.0) a.name = "current × " + text_of(current);
    if (supply != 1.0) {
      a.name += (a.name.empty() ? "supply × " : ", supply × ") + text_of(supply);
    }
    a.current_gain = current;
    a.supply_gain = supply;
    a.from_start = true;
    attacks.push_back(a);
  };
  for (const double gain : gains)
    add(gain, 1.0);
  for (const double gain : gains)
    add(1.0, gain);
  // Their quotient, the resistance, is right or nearly so.
  for (const double gain : gains)
    add(gain, gain);
  add(0.64, 0.83);
  add(0.78, 0.95);
  add(1.3, 1.05);
  add(0.5, 1.5);
  add(1.5, 0.5);
}

void add_cooling(std::vector<Attack>& attacks) {
  for (const bool blocked : {false, true}) {
    for (const double ratio : {0.2, 0.25, 0.4, worst_configured_cooling, 1.0, 2.0}) {
      Attack a;
      a.name = (blocked ? "blocked, cooling × " : "cooling × ") + text_of(ratio);
      a.cooling_ratio = ratio;
      a.blocked = blocked;
      if (ratio < worst_configured_cooling) {
        a.guard = "thermal fuse";
        a.blindness = worse_cooling;
      }
      attacks.push_back(a);
    }
  }
}

void add_leaks(std::vector<Attack>& attacks) {
  for (const double percent : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0}) {
    Attack a;
    a.name = leak_text(percent);
    a.switch_leak_ratio = 0.01 * percent;
    if (percent <= 5.0) a.blindness = leak_as_noise;
    attacks.push_back(a);
  }
}

void add_hot_air(std::vector<Attack>& attacks) {
  for (const double air_C : {40.0, 60.0}) {
    Attack a;
    a.name = "air at " + text_of(air_C) + " °C";
    a.air_C = air_C;
    a.from_start = true;
    a.blindness = warmer_air;
    attacks.push_back(a);
  }
}

void add_measured_air(std::vector<Attack>& attacks) {
  const auto add = [&](const std::string& name, double air_C, double offset_K, bool identified) {
    Attack a;
    a.name = (identified ? "identified, " : "") + name;
    a.air_C = air_C;
    a.air_sensor_offset_K = offset_K;
    a.from_start = true;
    a.identified = identified;
    attacks.push_back(a);
  };
  for (const bool identified : {false, true}) {
    for (const double air_C : {0.0, 40.0, 60.0})
      add("air at " + text_of(air_C) + " °C, measured", air_C, -1.9, identified);
    add("the wire of the air's sensor is off", 30.0, -200.0, identified);
  }
  // A lost contact has to be found sooner here.
  for (const double air_C : {40.0, 60.0}) {
    add("blocked, cooling × 0.25, air at " + text_of(air_C) + " °C, measured", air_C, -1.9, true);
    attacks.back().blocked = true;
    attacks.back().cooling_ratio = 0.25;
    attacks.back().from_start = false;
    attacks.back().guard = "thermal fuse";
    attacks.back().blindness = worse_cooling;
  }
}

/// Repeats on an identified muscle each attack to which the firmware is blind.
void add_identified(std::vector<Attack>& attacks) {
  const std::vector<Attack> others = attacks;
  for (Attack a : others) {
    if (a.blindness.empty()) continue;
    a.name = "identified, " + a.name;
    a.identified = true;
    // Compared senses leave the hot end no margin for air that is hotter than it knows.
    if (a.air_C >= 60.0) a.guard = "thermal fuse";
    attacks.push_back(a);
  }
}

}  // namespace

std::string text_of(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

std::string leak_text(double percent) {
  return percent < 100.0 ? "switch leaks " + text_of(percent) + " %" : "switch stuck on";
}

/// An identified muscle must prove that it responds, but not while identify runs.
std::string_view guard_in(Activity activity, const Attack& attack) {
  const bool proven = attack.identified && attack.blocked && activity != Activity::identify;
  return proven ? std::string_view() : attack.guard;
}

std::vector<Attack> all_attacks() {
  std::vector<Attack> attacks;
  add_lying_senses(attacks);
  add_cooling(attacks);
  add_leaks(attacks);
  add_hot_air(attacks);
  add_identified(attacks);
  add_measured_air(attacks);
  return attacks;
}

}  // namespace supercoil::test
