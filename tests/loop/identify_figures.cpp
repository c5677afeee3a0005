// What identify finds on muscles whose parameters the board believes up to 50 % too high or low:
//   identify_figures SEEDS [track|no [MUSCLE]]
// SEEDS: beliefs drawn for each muscle; track: also how learned_ff follows a sine after each of the
// first three. The figures of docs/identify-theory.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "loop/support/best_linear.hpp"
#include "loop/support/identified_muscle.hpp"

namespace {

using namespace supercoil;
using namespace supercoil::test;

struct Worst {
  int found = 0;
  int kept_theta1 = 0;
  std::array<double, 3> error{};  ///< largest of each, θ2 to θ4
  double max_s = 0.0;
  double hottest_C = 0.0;
  double hottest_published_C = 0.0;
  double max_m = 0.0;
  double min_m = 0.0;
  double tracking_m = 0.0;
};

void add(Worst& row, const MuscleKind& kind, const Identified& run, bool track, int seed) {
  row.max_s = std::max(row.max_s, run.took_s);
  row.hottest_C = std::max(row.hottest_C, run.hottest_C);
  row.hottest_published_C = std::max(row.hottest_published_C, run.hottest_published_C);
  row.max_m = std::max(row.max_m, run.max_m);
  row.min_m = std::min(row.min_m, run.min_m);
  if (run.result != ModeResult::found) {
    std::printf("  %s, seed %d: %s (%s), fault %s\n", kind.name.data(), seed,
                std::string(mode_result_names.at(static_cast<std::size_t>(run.result))).c_str(),
                describe_notes(run.notes).c_str(), std::string(name(run.fault)).c_str());
    return;
  }
  ++row.found;
  row.kept_theta1 += (run.notes & note_theta1_kept) != 0 ? 1 : 0;
  const control::Theta found = control::theta_from(run.learned->muscle);
  const bool linear = kind.plant.find("preset") == std::string_view::npos || kind.name == "paper";
  const control::Theta truth =
      linear ? control::theta_from(run.truth)
             : best_linear(run.position_m, run.power_W, run.truth.moving_mass_kg);
  for (int i = 0; i < 3; ++i) {
    double& worst = row.error.at(static_cast<std::size_t>(i));
    const double error = found[i + 1] / truth[i + 1] - 1.0;
    if (std::abs(error) > std::abs(worst)) worst = error;
  }
  if (track && seed <= 3) row.tracking_m = std::max(row.tracking_m, tracking_after(kind, seed));
}

void print(const MuscleKind& kind, const Worst& r, int seeds, bool track) {
  std::printf("| %s | %d/%d | %d | %.2g / %.2g / %.2g | %.0f | %.0f (%.0f) | %.1f to %.1f |",
              kind.name.data(), r.found, seeds, r.kept_theta1, 100.0 * r.error[0],
              100.0 * r.error[1], 100.0 * r.error[2], r.max_s, r.hottest_C, r.hottest_published_C,
              1e3 * r.min_m, 1e3 * r.max_m);
  if (track) std::printf(" %.1f |", 1e6 * r.tracking_m);
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 1;
  const bool track = argc > 2 && std::string_view(argv[2]) == "track";
  std::printf(
      "| muscle | found | believed θ1 kept | θ2, θ3, θ4 off by, %% | s | °C (told) | mm |%s\n",
      track ? " µm rms |" : "");
  try {
    for (const MuscleKind& kind : muscle_kinds) {
      if (argc > 3 && kind.name != argv[3]) continue;
      Worst row;
      for (int seed = 1; seed <= seeds; ++seed)
        add(row, kind, run_identify(kind, seed), track, seed);
      print(kind, row, seeds, track);
    }
  } catch (const std::exception& error) {
    std::fputs(error.what(), stderr);
    return 1;
  }
  return 0;
}
