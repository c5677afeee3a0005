#include "attack/joint_attack.hpp"

namespace supercoil::test {

namespace {

using Attacks = std::vector<JointAttack>;

constexpr std::array<std::string_view, 2> muscle_names{"agonist", "antagonist"};

/// To the agonist, and to the antagonist.
void add_to_each(Attacks& attacks, const std::string& what, const MuscleHarm& harm,
                 const JointAttack& other = {}) {
  for (std::size_t muscle = 0; muscle < muscle_names.size(); ++muscle) {
    JointAttack a = other;
    a.name = std::string(muscle_names[muscle]) + ": " + what;
    a.muscles[muscle] = harm;
    attacks.push_back(a);
  }
}

void add_lying_senses(Attacks& attacks) {
  JointAttack from_start;
  from_start.from_start = true;
  for (const double gain : {0.64, 0.78, 1.3, 1.5}) {
    add_to_each(attacks, "current × " + text_of(gain), {.current_gain = gain}, from_start);
  }
  for (const double gain : {0.78, 0.9, 1.3}) {
    JointAttack a = from_start;
    a.name = "supply × " + text_of(gain);
    a.supply_gain = gain;
    attacks.push_back(a);
  }
}

/// Worse than configured.
JointAttack bad_cooling() {
  JointAttack a;
  a.guard = "thermal fuse";
  a.blindness = worse_cooling;
  return a;
}

void add_cooling(Attacks& attacks) {
  for (const bool jammed : {false, true}) {
    for (const double ratio : {0.2, 0.4, worst_configured_cooling, 2.0}) {
      JointAttack other = ratio < worst_configured_cooling ? bad_cooling() : JointAttack();
      other.jammed = jammed;
      const std::string what = (jammed ? "jammed, cooling × " : "cooling × ") + text_of(ratio);
      add_to_each(attacks, what, {.cooling_ratio = ratio}, other);
    }
  }
}

void add_lost_pull(Attacks& attacks) {
  add_to_each(attacks, "torn", {.torn = true});
  add_to_each(attacks, "slack of 3 mm", {.slack_m = 0.003});
  add_to_each(attacks, "slack of 3 mm, cooling × 0.4", {.cooling_ratio = 0.4, .slack_m = 0.003},
              bad_cooling());
}

void add_leaks(Attacks& attacks) {
  for (const double percent : {1.0, 5.0, 20.0, 100.0}) {
    JointAttack other;
    if (percent <= 5.0) other.blindness = leak_as_noise;
    add_to_each(attacks, leak_text(percent), {.switch_leak_ratio = 0.01 * percent}, other);
  }
}

void add_sensor(Attacks& attacks) {
  for (const double gain : {0.0, 0.5, 1.5}) {
    JointAttack a;
    a.name = gain == 0.0 ? "the sensor's magnet came off" : "position × " + text_of(gain);
    a.position_gain = gain;
    a.from_start = true;
    attacks.push_back(a);
  }
}

/// What is soldered or mounted wrongly, and air that nobody expected.
void add_mistakes(Attacks& attacks) {
  const auto add = [&](const std::string& name) -> JointAttack& {
    JointAttack& a = attacks.emplace_back();
    a.name = name;
    a.from_start = true;
    return a;
  };
  add("the sensor is upside down").position_gain = -1.0;
  add("heaters swapped").swapped_heaters = true;
  add("current senses swapped").swapped_currents = true;
  JointAttack& both = add("heaters and current senses swapped");
  both.swapped_heaters = both.swapped_currents = true;
  both.blindness = "each channel heats the other's muscle, and tells of its own";
  JointAttack& air = add("air at 60 °C");
  air.air_C = 60.0;
  air.blindness = warmer_air;
}

void add_identified(Attacks& attacks) {
  const Attacks others = attacks;
  for (JointAttack a : others) {
    if (a.blindness.empty() && !a.jammed) continue;
    a.name = "identified, " + a.name;
    a.identified = true;
    if (a.air_C >= 60.0) a.guard = "thermal fuse";
    attacks.push_back(a);
  }
}

}  // namespace

Attacks all_joint_attacks() {
  Attacks attacks;
  add_lying_senses(attacks);
  add_cooling(attacks);
  add_lost_pull(attacks);
  add_leaks(attacks);
  add_sensor(attacks);
  add_mistakes(attacks);
  add_identified(attacks);
  return attacks;
}

}  // namespace supercoil::test
