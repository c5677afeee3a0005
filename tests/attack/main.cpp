// Every attack on every muscle in every activity, a line each: attack_table.py judges them.
//   attacks [EVERY]    EVERY: takes every so many only
#include <cstdio>
#include <cstdlib>

#include "attack/attacked_board.hpp"
#include "batch/in_parallel.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

struct Case {
  Attack attack;
  Muscle muscle;
  Activity activity;
};

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const Muscle& muscle : muscles) {
    for (const Attack& attack : all_attacks()) {
      for (std::size_t i = 0; i < activity_names.size(); ++i) {
        const auto activity = static_cast<Activity>(i);
        // Only a switch that conducts by itself heats what is disarmed.
        if (activity == Activity::disarmed && attack.switch_leak_ratio == 0.0) continue;
        cases.push_back({attack, muscle, activity});
      }
    }
  }
  return cases;
}

std::string string_of(std::string_view text) {
  return std::string(text);
}

void print(const Case& c, const Damage& damage) {
  const auto fault = damage.fault == Fault::none ? std::string_view() : name(damage.fault);
  const auto activity = activity_names[static_cast<std::size_t>(c.activity)];
  std::printf("%s;%s;%s;%.1f;%.1f;%s;%.1f;%s;%s\n", string_of(c.muscle.name).c_str(),
              c.attack.name.c_str(), string_of(activity).c_str(), damage.hottest_C,
              damage.outside_K, string_of(fault).c_str(), damage.fault_s,
              string_of(guard_in(c.activity, c.attack)).c_str(),
              string_of(c.attack.blindness).c_str());
}

}  // namespace

int main(int argc, char** argv) {
  const int every = argc > 1 ? std::atoi(argv[1]) : 1;
  std::vector<Case> cases;
  const std::vector<Case> all = all_cases();
  for (std::size_t i = 0; i < all.size(); i += static_cast<std::size_t>(every))
    cases.push_back(all[i]);
  std::vector<Damage> damages(cases.size());
  host_sim::batch::in_parallel(
      cases.size(), host_sim::batch::threads_for(0),
      [&](std::size_t i, const std::atomic<bool>&) -> host_sim::batch::Handover {
        const Damage damage =
            AttackedBoard(cases[i].attack, cases[i].muscle, cases[i].activity).run();
        return [&damages, i, damage] { damages[i] = damage; };
      },
      [] { return false; });
  for (std::size_t i = 0; i < cases.size(); ++i)
    print(cases[i], damages[i]);
  return 0;
}
