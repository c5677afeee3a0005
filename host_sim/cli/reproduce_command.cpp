#include <cstdio>

#include "apps/common/progress.hpp"
#include "cli/commands.hpp"
#include "cli/run_results.hpp"
#include "paper/reproduction.hpp"
#include "report/output_folder.hpp"
#include "report/reproduction_table.hpp"

namespace supercoil::host_sim {

namespace {

/// Draws every figure into the folder and returns their texts; empty where one could not be drawn.
std::vector<std::string> draw_all(const std::vector<paper::Part>& parts, OutputFolder& folder) {
  std::vector<std::string> texts;
  for (const paper::Part& part : parts) {
    for (const paper::NamedFigure& figure : part.figures)
      texts.push_back(draw_into(folder, figure.figure, figure.name + ".svg"));
  }
  return texts;
}

}  // namespace

int reproduce_command(const ReproduceOptions& options) {
  auto folder = OutputFolder::open(options.out);
  if (!folder) return fail(exit_wrong_input, folder.error());
  Progress progress("reproducing the paper", options.quiet);
  const auto parts = paper::reproduce([&](double done) { progress.show(done, ""); });

  std::vector<std::string> pictures;
  if (options.plots) {
    pictures = draw_all(parts, *folder);
    if (auto page = folder->write("report.html", to_html(parts, pictures)); !page) {
      return fail(exit_failed, page.error());
    }
  }
  if (auto csv = folder->write("reproduction.csv", to_csv(parts)); !csv) {
    return fail(exit_failed, csv.error());
  }
  if (auto done = folder->commit(); !done) return fail(exit_failed, done.error());
  if (!options.quiet) {
    std::fputs(to_terminal(parts).c_str(), stdout);
    std::printf("\n%.1f s. Table: %s/reproduction.csv\n", progress.elapsed_s(),
                options.out.c_str());
    if (options.plots) std::printf("Page with plots: %s/report.html\n", options.out.c_str());
  }
  return exit_done;
}

}  // namespace supercoil::host_sim
