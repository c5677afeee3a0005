// Width of the published interval, and how far a muscle may heat up, by what is known of its heat;
// checks that the interval holds the truth and nothing trips. docs/safety.md has the table.
//   known_heat [SEEDS [JOBS]]    all muscles; without arguments, the cases of the suite
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "batch/in_parallel.hpp"
#include "loop/known_heat/known_board.hpp"

using namespace supercoil;
using namespace supercoil::test;
using host_sim::MusclePreset;

namespace {

struct Case {
  MuscleCase muscle;
  Knowledge knowledge;
  std::uint64_t seed;
  Findings findings{};
};

/// What must be reached on this muscle.
struct Goal {
  MusclePreset preset;
  Knowledge knowledge;
  double max_width_K;  ///< infinite: not judged
  double min_reach_ratio;
};
constexpr std::array<Goal, 6> goals{{
    {MusclePreset::real, Knowledge::weighed, 18.0, 0.0},
    {MusclePreset::real, Knowledge::thermometer, 10.0, 0.0},
    {MusclePreset::b, Knowledge::weighed, INFINITY, 0.70},
    {MusclePreset::c, Knowledge::weighed, INFINITY, 0.70},
    {MusclePreset::b, Knowledge::thermometer, INFINITY, 0.85},
    {MusclePreset::c, Knowledge::thermometer, INFINITY, 0.85},
}};

std::vector<Case> all_cases(std::uint64_t seeds) {
  std::vector<Case> cases;
  for (const auto& [preset, max_W] :
       {std::pair{MusclePreset::paper, 4.5}, std::pair{MusclePreset::real, 4.5},
        std::pair{MusclePreset::real_hard, 4.5}, std::pair{MusclePreset::b, 2.15},
        std::pair{MusclePreset::c, 3.1}}) {
    for (const double cooling : {1.0, 0.5, 2.0}) {
      const MuscleCase muscle{preset, cooling, max_W * std::min(1.0, cooling)};
      for (std::size_t i = 0; i < knowledge_names.size(); ++i) {
        for (std::uint64_t seed = 1; seed <= seeds; ++seed)
          cases.push_back({muscle, static_cast<Knowledge>(i), seed});
      }
    }
  }
  return cases;
}

/// The cases with a goal, and the hardest muscle.
std::vector<Case> suite_cases() {
  std::vector<Case> cases;
  for (const Goal& goal : goals) {
    if (goal.preset == MusclePreset::real)
      cases.push_back({{goal.preset, 1.0, 4.5}, goal.knowledge, 1});
    if (goal.preset == MusclePreset::b)
      cases.push_back({{goal.preset, 1.0, 2.15}, goal.knowledge, 2});
  }
  cases.push_back({{MusclePreset::real_hard, 1.0, 4.5}, Knowledge::thermometer_alone, 3});
  cases.push_back({{MusclePreset::paper, 1.0, 4.5}, Knowledge::defaults, 4});
  return cases;
}

void run(std::vector<Case>& cases, int jobs) {
  host_sim::batch::in_parallel(
      cases.size(), host_sim::batch::threads_for(jobs),
      [&](std::size_t i, const std::atomic<bool>&) -> host_sim::batch::Handover {
        const Findings f = measure(cases[i].muscle, cases[i].knowledge, cases[i].seed);
        return [&cases, i, f] { cases[i].findings = f; };
      },
      [] { return false; });
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Prints one row of the table, over all seeds; returns whether it is as it must be.
bool judge(const std::vector<Case>& seeds) {
  const Case& first = seeds.front();
  std::vector<double> widths_K;
  std::vector<double> reaches;
  std::int64_t outside_ticks = 0;
  double outside_K = -1e9;
  int found = 0;
  int read = 0;
  Fault fault = Fault::none;
  for (const Case& c : seeds) {
    const Findings& f = c.findings;
    widths_K.push_back(f.median_width_K);
    reaches.push_back(f.reach_ratio);
    outside_ticks += f.outside_ticks;
    outside_K = std::max(outside_K, f.outside_K);
    found += f.cooling_found ? 1 : 0;
    read += f.read ? 1 : 0;
    if (f.fault != Fault::none) fault = f.fault;
  }
  const auto name_of_muscle = control::name_of(host_sim::preset_names, first.muscle.preset);
  std::printf("| %s, cooling × %g | %s | %.1f K | %.0f %% | %lld | %.2f K | %s | %d | %d |\n",
              std::string(name_of_muscle).c_str(), first.muscle.cooling_ratio,
              std::string(knowledge_names[static_cast<std::size_t>(first.knowledge)]).c_str(),
              median(widths_K), 100.0 * median(reaches), static_cast<long long>(outside_ticks),
              -outside_K, fault == Fault::none ? "–" : std::string(name(fault)).c_str(), found,
              read);
  bool good = outside_ticks == 0 && fault == Fault::none;
  for (const Goal& goal : goals) {
    const bool meant = goal.preset == first.muscle.preset && goal.knowledge == first.knowledge &&
                       first.muscle.cooling_ratio == 1.0;
    if (!meant) continue;
    good = good && median(widths_K) <= goal.max_width_K && median(reaches) >= goal.min_reach_ratio;
  }
  if (!good) std::printf("^ not as it must be\n");
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  const auto seeds = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 0;
  std::vector<Case> cases = seeds > 0 ? all_cases(seeds) : suite_cases();
  run(cases, argc > 2 ? std::atoi(argv[2]) : 0);
  std::printf(
      "| muscle | known | median width | reach | ticks outside | nearest to an end | fault "
      "| τ found | read |\n|---|---|---|---|---|---|---|---|---|\n");
  bool good = true;
  for (std::size_t i = 0; i < cases.size();) {
    std::vector<Case> row;
    const auto same = [&](const Case& c) {
      return c.muscle.preset == cases[i].muscle.preset &&
             c.muscle.cooling_ratio == cases[i].muscle.cooling_ratio &&
             c.knowledge == cases[i].knowledge;
    };
    std::size_t end = i;
    while (end < cases.size() && same(cases[end]))
      row.push_back(cases[end++]);
    good = judge(row) && good;
    i = end;
  }
  return good ? 0 : 1;
}
