#include "attack/joint_attack.hpp"

namespace supercoil::test {

namespace {

using Attacks = std::vector<JointAttack>;

constexpr std::array<NamedMuscle, 2> joint_muscles{{{0, "agonist"}, {1, "antagonist"}}};

void add_joint_cooling(Attacks& attacks) {
  for (const bool jammed : {false, true}) {
    for (const double ratio : {0.2, 0.4, worst_configured_cooling, 2.0}) {
      auto other = cooled_by<JointAttack>(ratio);
      other.jammed = jammed;
      add_to_each(attacks, joint_muscles,
                  (jammed ? "jammed, cooling × " : "cooling × ") + text_of(ratio),
                  {.cooling_ratio = ratio}, other);
    }
  }
}

void add_lost_pull(Attacks& attacks) {
  add_to_each(attacks, joint_muscles, "torn", {.torn = true});
  add_to_each(attacks, joint_muscles, "slack of 3 mm", {.slack_m = 0.003});
  add_to_each(attacks, joint_muscles, "slack of 3 mm, cooling × 0.4",
              {.cooling_ratio = 0.4, .slack_m = 0.003}, cooled_by<JointAttack>(0.4));
}

void add_sensor(Attacks& attacks) {
  for (const double gain : {0.0, 0.5, 1.5}) {
    add_from_start(attacks,
                   gain == 0.0 ? "the sensor's magnet came off" : "position × " + text_of(gain))
        .position_gain = gain;
  }
}

/// What is soldered or mounted wrongly, and air that nobody expected.
void add_mistakes(Attacks& attacks) {
  add_from_start(attacks, "the sensor is upside down").position_gain = -1.0;
  add_from_start(attacks, "heaters swapped").swapped_heaters = true;
  add_from_start(attacks, "current senses swapped").swapped_currents = true;
  JointAttack& both = add_from_start(attacks, "heaters and current senses swapped");
  both.swapped_heaters = both.swapped_currents = true;
  both.blindness = "each channel heats the other's muscle but reports its own";
  add_hot_air(attacks);
}

}  // namespace

Attacks all_joint_attacks() {
  Attacks attacks;
  add_lying_senses(attacks, joint_muscles);
  add_joint_cooling(attacks);
  add_lost_pull(attacks);
  add_leaks(attacks, joint_muscles);
  add_sensor(attacks);
  add_mistakes(attacks);
  add_identified(
      attacks, +[](const JointAttack& a) { return a.jammed; });
  return attacks;
}

}  // namespace supercoil::test
