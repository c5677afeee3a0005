#include <cstdio>
#include <utility>

#include "batch/in_parallel.hpp"
#include "cli/commands.hpp"
#include "cli/compare_results.hpp"
#include "cli/kept_runs.hpp"
#include "cli/results_json.hpp"
#include "compare/run_plan.hpp"
#include "report/output_folder.hpp"

namespace supercoil::host_sim {

namespace {

using compare::Results;

compare::Key key_of(const compare::Plan& plan, const compare::Run& run) {
  const compare::Case& planned = plan.cases[run.case_index];
  return {planned.controller, planned.disturbance, planned.arithmetic, run.seed};
}

/// The plan's runs without a result; an error if a result was made with another definition.
Result<std::vector<compare::Run>> missing(const compare::Plan& plan, const Results& results,
                                          const std::string& file) {
  std::vector<compare::Run> runs;
  for (const compare::Run& run : plan.runs) {
    const auto entry = results.find(key_of(plan, run));
    const compare::Case& planned = plan.cases[run.case_index];
    if (entry == results.end()) {
      runs.push_back(run);
    } else if (entry->second.definition != planned.definition) {
      return failure(file + ": its " + planned.controller + " with " + planned.disturbance +
                     " was run with another definition; choose another --out, or delete it");
    }
  }
  return runs;
}

}  // namespace

int compare_command(const CompareOptions& options) {
  if (options.list) return list_compared(options.json);
  if (!options.merge.empty()) return merge_comparisons(options);
  const auto plan = compare::make_plan(options.selection);
  if (!plan) return refuse_lines(options.json, plan.error().text());
  for (const std::string& reason : plan->impossible)
    std::fprintf(stderr, "supercoil-sim: left out: %s", reason.c_str());
  if (plan->runs.empty()) {
    return refuse(options.json, exit_wrong_input,
                  "there is nothing to run: all is left out, or this part has no runs");
  }
  auto folder = OutputFolder::open(options.out);
  if (!folder) return refuse(options.json, exit_wrong_input, folder.error().text());

  const std::filesystem::path path = folder->path() / runs_name;
  auto before = compare::read_results(path);
  if (!before) return refuse(options.json, exit_wrong_input, before.error().text());
  Results results = std::move(before->results);
  const auto todo = missing(*plan, results, path.string());
  if (!todo) return refuse(options.json, exit_wrong_input, todo.error().text());
  KeptRuns kept("comparing", {results.size(), plan->runs.size(), todo->size(), before->torn},
                *folder, options.quiet);
  if (const int failed = kept.begin(compare::to_file(results)); failed != exit_done) return failed;
  if (!todo->empty()) {
    run_plan(plan->cases, *todo, batch::threads_for(options.jobs),
             {[&](const compare::Run& run, const compare::Result& result) {
                const compare::Key key = key_of(*plan, run);
                kept.add(compare::to_line(key, result));
                results.emplace(key, result);
              },
              [&] { return kept.stop(); }});
  }
  if (const int failed = kept.end(); failed != exit_done) return failed;
  return conclude_comparison(results, *folder, options);
}

}  // namespace supercoil::host_sim
