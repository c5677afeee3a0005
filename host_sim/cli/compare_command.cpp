#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <utility>

#include "cli/commands.hpp"
#include "cli/compare_results.hpp"
#include "cli/progress.hpp"
#include "cli/run_results.hpp"
#include "compare/in_parallel.hpp"
#include "compare/run_plan.hpp"
#include "report/output_folder.hpp"

namespace supercoil::host_sim {

namespace {

using compare::Results;

compare::Key key_of(const compare::Plan& plan, const compare::Run& run) {
  const compare::Case& of = plan.cases[run.of];
  return {of.controller, of.disturbance, of.arithmetic, run.seed};
}

std::string duration(double seconds) {
  const std::int64_t whole = std::llround(seconds);
  constexpr std::int64_t minute = 60;
  if (whole < 2 * minute) return std::to_string(whole) + " s";
  return std::to_string((whole + minute / 2) / minute) + " min";
}

/// What of the plan is not among the results; an error where it is, made of something else.
tl::expected<std::vector<compare::Run>, std::string> missing(const compare::Plan& plan,
                                                             const Results& results,
                                                             const std::string& file) {
  std::vector<compare::Run> runs;
  for (const compare::Run& run : plan.runs) {
    const auto there = results.find(key_of(plan, run));
    const compare::Case& of = plan.cases[run.of];
    if (there == results.end()) {
      runs.push_back(run);
    } else if (there->second.definition != of.definition) {
      return tl::unexpected(file + ": its " + of.controller + " with " + of.disturbance +
                            " was made by another definition; choose another --out, or delete it");
    }
  }
  return runs;
}

/// Carries the runs out and appends each to the file as it ends. False when it was interrupted.
bool run_all(const compare::Plan& plan, const std::vector<compare::Run>& todo, Results& results,
             std::ofstream& file, const CompareOptions& options) {
  Progress progress("comparing", options.quiet);
  std::size_t ended = 0;
  run_plan(plan.cases, todo, compare::threads_for(options.jobs),
           {[&](const compare::Run& run, const compare::Result& result) {
              const compare::Key key = key_of(plan, run);
              file << compare::to_line(key, result) << std::flush;
              results.emplace(key, result);
              ++ended;
            },
            [&] {
              const double part = static_cast<double>(ended) / static_cast<double>(todo.size());
              const double left_s = progress.elapsed_s() * (1.0 - part) / part;
              progress.show(part, std::to_string(ended) + " of " + std::to_string(todo.size()) +
                                      " runs" +
                                      (ended > 0 ? ", " + duration(left_s) + " left" : ""));
              return interrupted() || !file;
            }});
  return ended == todo.size();
}

}  // namespace

int compare_command(const CompareOptions& options) {
  if (options.list) return list_compared();
  if (!options.merge.empty()) return merge_comparisons(options);
  const auto plan = compare::make_plan(options.selection);
  if (!plan) {
    std::fputs(plan.error().c_str(), stderr);
    return exit_wrong_input;
  }
  for (const std::string& reason : plan->left_out)
    std::fprintf(stderr, "supercoil-sim: left out: %s", reason.c_str());
  auto folder = OutputFolder::open(options.out);
  if (!folder) return fail(exit_wrong_input, folder.error());

  const std::filesystem::path path = folder->path() / runs_name;
  auto before = compare::read_results(path);
  if (!before) return fail(exit_wrong_input, before.error());
  if (before->torn) {
    std::fprintf(stderr, "supercoil-sim: %s: its last line is torn; that run is repeated\n",
                 path.c_str());
  }
  Results results = std::move(before->results);
  const auto todo = missing(*plan, results, path.string());
  if (!todo) return fail(exit_wrong_input, todo.error());
  if (!options.quiet && todo->size() < plan->runs.size()) {
    std::fprintf(stderr, "supercoil-sim: %zu of %zu runs are already in %s\n",
                 plan->runs.size() - todo->size(), plan->runs.size(), path.c_str());
  }
  // From here on the file is whole, and grows by whole lines.
  if (const auto kept = folder->write(runs_name, compare::to_file(results)); !kept)
    return fail(exit_failed, kept.error());
  if (const auto kept = folder->commit(); !kept) return fail(exit_failed, kept.error());
  std::ofstream file(path, std::ios::binary | std::ios::app);
  catch_interrupts();
  const bool complete = todo->empty() || run_all(*plan, *todo, results, file, options);
  if (!file) return fail(exit_failed, path.string() + ": cannot be written");
  if (!complete) {
    return fail(exit_interrupted, "interrupted; " + std::to_string(results.size()) +
                                      " runs are kept in " + path.string() +
                                      "; the same command goes on from there");
  }
  return conclude_comparison(results, *folder, options);
}

}  // namespace supercoil::host_sim
