#include <cstdint>
#include <utility>

#include "cli/commands.hpp"
#include "cli/progress.hpp"
#include "cli/run_results.hpp"
#include "cli/tables.hpp"
#include "compare/in_parallel.hpp"
#include "estimators/results.hpp"
#include "report/output_folder.hpp"

namespace supercoil::host_sim {

namespace {

using estimators::Key;
using estimators::Outcomes;

/// All runs, of a seed before the next seed.
std::vector<Key> runs_of(std::int64_t seeds) {
  std::vector<Key> runs;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(seeds); ++seed) {
    for (std::size_t trial = 0; trial < estimators::trials.size(); ++trial) {
      for (std::size_t i = 0; i < estimators::contenders.size(); ++i)
        runs.push_back({trial, i, seed});
    }
  }
  return runs;
}

Outcomes try_all(const std::vector<Key>& runs, const EstimatorsOptions& options) {
  Progress progress("comparing estimators", options.quiet);
  Outcomes outcomes;
  compare::in_parallel(
      runs.size(), compare::threads_for(options.jobs),
      [&](std::size_t number, const std::atomic<bool>& stop) -> compare::Handover {
        const Key& key = runs[number];
        auto outcome = estimators::run(estimators::contenders[key.contender],
                                       estimators::trials[key.trial], key.seed, stop);
        if (!outcome) return {};
        return [&outcomes, key, done = std::move(*outcome)] { outcomes.emplace(key, done); };
      },
      [&] {
        progress.show(
            static_cast<double>(outcomes.size()) / static_cast<double>(runs.size()),
            std::to_string(outcomes.size()) + " of " + std::to_string(runs.size()) + " runs");
        return interrupted();
      });
  return outcomes;
}

estimators::AllBounds all_bounds() {
  estimators::AllBounds bounds;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    if (estimators::trials[i].noise_m > 0.0) bounds[i] = bounds_of(estimators::trials[i]);
  }
  return bounds;
}

}  // namespace

int estimators_command(const EstimatorsOptions& options) {
  auto folder = OutputFolder::open(options.out);
  if (!folder) return fail(exit_wrong_input, folder.error());
  catch_interrupts();
  const auto runs = runs_of(options.seeds);
  const Outcomes outcomes = try_all(runs, options);
  if (outcomes.size() < runs.size()) return fail(exit_interrupted, "interrupted; nothing is kept");
  const auto bounds = all_bounds();
  const std::string markdown =
      estimators::to_markdown(outcomes, bounds, estimators::measure_costs());
  if (options.plot) draw_into(*folder, estimators::figure_of(outcomes, bounds), "estimators.svg");
  return conclude_tables(
      {{{"estimators.csv", estimators::to_csv(outcomes, bounds)}, {"estimators.md", markdown}},
       markdown,
       runs.size()},
      *folder, options.quiet);
}

}  // namespace supercoil::host_sim
