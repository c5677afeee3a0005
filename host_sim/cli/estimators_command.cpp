#include <algorithm>
#include <array>
#include <cstdio>
#include <thread>
#include <utility>

#include "cli/commands.hpp"
#include "cli/progress.hpp"
#include "cli/run_results.hpp"
#include "compare/in_parallel.hpp"
#include "estimators/results.hpp"
#include "report/output_folder.hpp"

namespace supercoil::host_sim {

namespace {

using estimators::Key;
using estimators::Outcomes;

/// All runs, of a seed before the next seed.
std::vector<Key> runs_of(long seeds) {
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
  const auto jobs = options.jobs > 0 ? static_cast<unsigned>(options.jobs)
                                     : std::max(1U, std::thread::hardware_concurrency());
  Outcomes outcomes;
  compare::in_parallel(
      runs.size(), jobs,
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
  const std::array<std::pair<const char*, std::string>, 2> files{
      {{"estimators.csv", estimators::to_csv(outcomes, bounds)}, {"estimators.md", markdown}}};
  for (const auto& [name, content] : files) {
    if (const auto written = folder->write(name, content); !written)
      return fail(exit_failed, written.error());
  }
  constexpr const char* picture = "estimators.svg";
  if (options.plot) {
    const auto figure = estimators::figure_of(outcomes, bounds);
    if (const auto drawn = draw(figure, folder->temporary(picture)); !drawn) {
      folder->drop(picture);
      std::fprintf(stderr, "supercoil-sim: %s is not written: %s\n", picture,
                   drawn.error().c_str());
    }
  }
  if (const auto done = folder->commit(); !done) return fail(exit_failed, done.error());
  if (!options.quiet) {
    std::fputs(markdown.c_str(), stdout);
    std::printf("\n%zu runs, written to %s\n", runs.size(), folder->path().c_str());
  }
  return exit_done;
}

}  // namespace supercoil::host_sim
