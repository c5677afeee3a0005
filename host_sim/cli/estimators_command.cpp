#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>

#include "batch/in_parallel.hpp"
#include "cli/commands.hpp"
#include "cli/kept_runs.hpp"
#include "cli/results_json.hpp"
#include "cli/run_results.hpp"
#include "cli/tables.hpp"
#include "estimators/kept_outcomes.hpp"
#include "report/output_folder.hpp"

namespace supercoil::host_sim {

namespace {

using estimators::Key;
using estimators::Outcomes;

/// All runs; all of one seed before the next seed.
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

/// Carries the runs out.
void try_all(const std::vector<Key>& runs, Outcomes& outcomes, KeptRuns& kept,
             const EstimatorsOptions& options) {
  batch::in_parallel(
      runs.size(), batch::threads_for(options.jobs),
      [&](std::size_t number, const std::atomic<bool>& stop) -> batch::Handover {
        const Key& key = runs[number];
        auto outcome = estimators::run(estimators::contenders[key.contender],
                                       estimators::trials[key.trial], key.seed, stop);
        if (!outcome) return {};
        return [&outcomes, &kept, key, done = std::move(*outcome)] {
          kept.add(estimators::to_line(key, done));
          outcomes.emplace(key, done);
        };
      },
      [&] { return kept.stop(); });
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
  if (!folder) return refuse(options.json, exit_wrong_input, folder.error().text());
  auto before = estimators::read_outcomes(folder->path() / runs_name);
  if (!before) return refuse(options.json, exit_wrong_input, before.error().text());
  Outcomes outcomes = std::move(before->outcomes);
  const auto all = runs_of(options.seeds);
  std::vector<Key> todo;
  std::ranges::copy_if(all, std::back_inserter(todo),
                       [&](const Key& key) { return !outcomes.contains(key); });
  KeptRuns kept("comparing estimators", {outcomes.size(), all.size(), todo.size(), before->torn},
                *folder, options.quiet);
  if (const int failed = kept.begin(estimators::to_file(outcomes)); failed != exit_done)
    return failed;
  if (!todo.empty()) try_all(todo, outcomes, kept, options);
  if (const int failed = kept.end(); failed != exit_done) return failed;
  const auto bounds = all_bounds();
  const std::string csv = estimators::to_csv(outcomes, bounds);
  const std::string markdown =
      estimators::to_markdown(outcomes, bounds, estimators::measure_costs());
  if (options.plot) write_svg(*folder, estimators::figure_of(outcomes, bounds), "estimators.svg");
  return conclude_tables({{{runs_name, estimators::to_file(outcomes)},
                           {"estimators.csv", csv},
                           {"estimators.md", markdown}},
                          markdown,
                          outcomes.size(),
                          rows_json(csv, {"trial", "estimator", "measure"})},
                         *folder, {options.json, options.quiet});
}

}  // namespace supercoil::host_sim
