#include <atomic>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <utility>

#include "apps/common/progress.hpp"
#include "batch/in_parallel.hpp"
#include "campaign/search.hpp"
#include "campaign/tables.hpp"
#include "cli/campaign_results.hpp"
#include "cli/results_json.hpp"
#include "cli/run_results.hpp"
#include "cli/tables.hpp"

namespace supercoil::host_sim {

namespace {

std::string file_of(const campaign::Study& study, std::size_t contender) {
  return "search-" + study.contenders[contender].name + ".toml";
}

/// One row per goal and contender, as in search.md.
nlohmann::ordered_json rows_of(const campaign::Study& study,
                               const std::map<std::size_t, campaign::WorstRun>& found) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const auto& [contender, worst] : found) {
    const bool ran = !worst.drawn.empty();
    for (const campaign::Goal& goal : study.goals) {
      const double value = ran ? worst.outcome.values.at(goal.quantity) : NAN;
      rows.push_back({{"controller", study.contenders[contender].name},
                      {"quantity", campaign::quantity(goal.quantity).name},
                      {"max", goal.max},
                      {"runs", worst.runs},
                      {"worst", value},
                      {"fault", worst.outcome.fault},
                      {"file", ran ? file_of(study, contender) : ""}});
    }
  }
  return rows;
}

}  // namespace

int search_campaign(const campaign::Study& study, const campaign::Draws& draws,
                    const CampaignOptions& options) {
  auto folder = OutputFolder::open(options.out);
  if (!folder) return refuse(options.json, exit_wrong_input, folder.error().text());
  catch_interrupts();
  Progress progress("searching", options.quiet);
  std::atomic<std::int64_t> runs = 0;
  const auto all =
      static_cast<double>(study.contenders.size()) * static_cast<double>(options.search);
  std::map<std::size_t, campaign::WorstRun> found;
  batch::in_parallel(
      study.contenders.size(), batch::threads_for(options.jobs),
      [&](std::size_t contender, const std::atomic<bool>& stop) -> batch::Handover {
        auto worst =
            campaign::search(study, draws, contender, options.search, stop, [&] { ++runs; });
        return [&found, contender, result = std::move(worst)] { found[contender] = result; };
      },
      [&] {
        progress.show(static_cast<double>(runs) / all, std::to_string(runs) + " runs");
        return interrupted();
      });
  progress.end();
  Tables tables{
      {}, to_markdown(study, found), static_cast<std::size_t>(runs.load()), rows_of(study, found)};
  for (const auto& [contender, worst] : found) {
    if (worst.drawn.empty()) continue;
    tables.files.emplace_back(file_of(study, contender),
                              replay(study, draws, worst.drawn, {0, contender}));
  }
  tables.files.emplace_back("search.md", tables.markdown);
  if (const int failed = conclude_tables(tables, *folder, {options.json, options.quiet});
      failed != exit_done)
    return failed;
  if (interrupted()) return fail(exit_interrupted, "interrupted; the results so far are written");
  return exit_done;
}

}  // namespace supercoil::host_sim
