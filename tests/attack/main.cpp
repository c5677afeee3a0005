// Every attack on every muscle, on joints of two and bundles of three of them, in every activity;
// prints a line for each, which attack_table.py judges.
//   attacks [EVERY]    EVERY: takes only every EVERY-th
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <span>

#include "attack/attacked_bundle.hpp"
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

bool heats_disarmed(const BundleAttack& attack) {
  return attack.muscles[0].switch_leak_ratio > 0.0 || attack.muscles[2].switch_leak_ratio > 0.0;
}

std::string_view guard_in(BundleActivity /*activity*/, const BundleAttack& attack) {
  return attack.guard;
}

std::string_view guard_in(JointActivity /*activity*/, const JointAttack& attack) {
  return attack.guard;
}

/// of: the suffix of the muscle's name, or "". activities: their names, disarmed first.
template <class Attacked, class Activity, class AnyAttack>
void add(std::vector<Case>& cases, const std::string& of, const std::vector<AnyAttack>& attacks,
         std::span<const std::string_view> activities) {
  for (const Muscle& muscle : muscles) {
    for (const AnyAttack& attack : attacks) {
      for (std::size_t i = heats_disarmed(attack) ? 0 : 1; i < activities.size(); ++i) {
        const auto activity = static_cast<Activity>(i);
        cases.push_back({std::string(muscle.name) + of, attack.name, std::string(activities[i]),
                         std::string(guard_in(activity, attack)), std::string(attack.blindness),
                         [=] { return Attacked(attack, muscle, activity).run(); }});
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
  add<AttackedMuscle, Activity>(all, "", all_attacks(), activity_names);
  add<AttackedJoint, JointActivity>(all, " joint", all_joint_attacks(), joint_activity_names);
  add<AttackedBundle, BundleActivity>(all, " bundle", all_bundle_attacks(), bundle_activity_names);
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
