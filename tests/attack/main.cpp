// Every attack on every muscle, and on joints of two of them, in every activity, a line each:
// attack_table.py judges them.
//   attacks [EVERY]    EVERY: takes every so many only
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "attack/attacked_joint.hpp"
#include "attack/attacked_muscle.hpp"
#include "batch/in_parallel.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

struct Case {
  std::string board;  ///< the muscle's name, or its joint's
  std::string attack;
  std::string activity;
  std::string guard;
  std::string blindness;
  std::function<Damage()> run;
};

// Only a switch that conducts by itself heats what is disarmed.
bool heats_disarmed(const Attack& attack) {
  return attack.switch_leak_ratio > 0.0;
}
bool heats_disarmed(const JointAttack& attack) {
  return attack.muscles[0].switch_leak_ratio > 0.0 || attack.muscles[1].switch_leak_ratio > 0.0;
}

void add_muscles(std::vector<Case>& cases) {
  for (const Muscle& muscle : muscles) {
    for (const Attack& attack : all_attacks()) {
      for (std::size_t i = 0; i < activity_names.size(); ++i) {
        const auto activity = static_cast<Activity>(i);
        if (activity == Activity::disarmed && !heats_disarmed(attack)) continue;
        cases.push_back({std::string(muscle.name), attack.name, std::string(activity_names[i]),
                         std::string(guard_in(activity, attack)), std::string(attack.blindness),
                         [=] { return AttackedMuscle(attack, muscle, activity).run(); }});
      }
    }
  }
}

void add_joints(std::vector<Case>& cases) {
  for (const Muscle& muscle : muscles) {
    for (const JointAttack& attack : all_joint_attacks()) {
      for (std::size_t i = 0; i < joint_activity_names.size(); ++i) {
        const auto activity = static_cast<JointActivity>(i);
        if (activity == JointActivity::disarmed && !heats_disarmed(attack)) continue;
        cases.push_back({std::string(muscle.name) + " joint", attack.name,
                         std::string(joint_activity_names[i]), std::string(attack.guard),
                         std::string(attack.blindness),
                         [=] { return AttackedJoint(attack, muscle, activity).run(); }});
      }
    }
  }
}

void print(const Case& c, const Damage& damage) {
  const std::string fault =
      damage.fault == Fault::none ? std::string() : std::string(name(damage.fault));
  std::printf("%s;%s;%s;%.1f;%.1f;%s;%.1f;%s;%s\n", c.board.c_str(), c.attack.c_str(),
              c.activity.c_str(), damage.hottest_C, damage.outside_K, fault.c_str(), damage.fault_s,
              c.guard.c_str(), c.blindness.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  const int every = argc > 1 ? std::atoi(argv[1]) : 1;
  std::vector<Case> all;
  add_muscles(all);
  add_joints(all);
  std::vector<Case> cases;
  for (std::size_t i = 0; i < all.size(); i += static_cast<std::size_t>(every))
    cases.push_back(all[i]);
  std::vector<Damage> damages(cases.size());
  host_sim::batch::in_parallel(
      cases.size(), host_sim::batch::threads_for(0),
      [&](std::size_t i, const std::atomic<bool>&) -> host_sim::batch::Handover {
        const Damage damage = cases[i].run();
        return [&damages, i, damage] { damages[i] = damage; };
      },
      [] { return false; });
  for (std::size_t i = 0; i < cases.size(); ++i)
    print(cases[i], damages[i]);
  return 0;
}
