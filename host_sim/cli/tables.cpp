#include "cli/tables.hpp"

#include <cstdio>

#include "cli/results_json.hpp"

namespace supercoil::host_sim {

int conclude_tables(const Tables& tables, OutputFolder& folder, TableOutput output) {
  for (const auto& [name, content] : tables.files) {
    if (const auto written = folder.write(name, content); !written)
      return fail(exit_failed, written.error().text());
  }
  if (const auto done = folder.commit(); !done) return fail(exit_failed, done.error().text());
  if (output.json) {
    print_results(
        {{"folder", folder.path().string()}, {"runs", tables.runs}, {"rows", tables.rows}});
  } else if (!output.quiet) {
    std::fputs(tables.markdown.c_str(), stdout);
    std::printf("\n%zu runs, written to %s\n", tables.runs, folder.path().c_str());
  }
  return exit_done;
}

}  // namespace supercoil::host_sim
