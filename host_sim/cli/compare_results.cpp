#include "cli/compare_results.hpp"

#include <cstdio>
#include <filesystem>

#include "batch/kept_lines.hpp"
#include "cli/kept_runs.hpp"
#include "cli/results_json.hpp"
#include "cli/run_results.hpp"
#include "cli/tables.hpp"
#include "compare/catalogue.hpp"
#include "compare/plot.hpp"

namespace supercoil::host_sim {

using compare::Results;

int conclude_comparison(const Results& results, OutputFolder& folder,
                        const CompareOptions& options) {
  const auto table = compare::table_of(results);
  const std::string markdown = compare::to_markdown(table);
  const std::string csv = compare::to_csv(table);
  if (options.plot) write_svg(folder, compare::figure_of(table), "compare.svg");
  return conclude_tables(
      {{{runs_name, compare::to_file(results)}, {"compare.csv", csv}, {"compare.md", markdown}},
       markdown,
       results.size(),
       rows_json(csv, {"controller", "disturbance", "arithmetic", "measure"})},
      folder, {options.json, options.quiet});
}

int merge_comparisons(const CompareOptions& options) {
  Results results;
  const auto added =
      batch::add_parts(options.merge, std::filesystem::path(options.out) / runs_name,
                       [&](const std::filesystem::path& part) -> Result<bool> {
                         const auto read = compare::read_results(part);
                         if (!read) return tl::unexpected(read.error());
                         return compare::merge(results, read->results, part.string()).map([&] {
                           return read->torn;
                         });
                       });
  if (!added) return refuse(options.json, exit_wrong_input, added.error().text());
  auto folder = OutputFolder::open(options.out);
  if (!folder) return refuse(options.json, exit_wrong_input, folder.error().text());
  return conclude_comparison(results, *folder, options);
}

int list_compared(bool json) {
  if (json) {
    nlohmann::ordered_json measures = nlohmann::ordered_json::array();
    for (const compare::Measure& measure : compare::measures)
      measures.push_back({{"name", measure.name}, {"description", measure.meaning}});
    print_results({{"controllers", entries_json(compare::controllers())},
                   {"disturbances", entries_json(compare::disturbances())},
                   {"measures", measures}});
    return exit_done;
  }
  const auto print = [](const char* title, const std::vector<BuiltinScenario>& entries) {
    std::puts(title);
    for (const BuiltinScenario& entry : entries) {
      std::printf("  %-18.*s %.*s\n", static_cast<int>(entry.name.size()), entry.name.data(),
                  static_cast<int>(description(entry).size()), description(entry).data());
    }
  };
  print("Controllers:", compare::controllers());
  print("\nDisturbances (most at 100 s; NAME+SECONDS delays one):", compare::disturbances());
  std::puts("\nMeasures of the true position against each controller's reference model:");
  for (const compare::Measure& measure : compare::measures) {
    std::printf("  %-18.*s %.*s\n", static_cast<int>(measure.name.size()), measure.name.data(),
                static_cast<int>(measure.meaning.size()), measure.meaning.data());
  }
  return exit_done;
}

}  // namespace supercoil::host_sim
