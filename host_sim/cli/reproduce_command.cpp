#include <cstdio>

#include "apps/common/progress.hpp"
#include "cli/commands.hpp"
#include "cli/results_json.hpp"
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
      texts.push_back(write_svg(folder, figure.figure, figure.name + ".svg"));
  }
  return texts;
}

/// Printed and measured values may be a number, a range or words: all are text.
nlohmann::ordered_json rows_of(const std::vector<paper::Part>& parts) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const paper::Part& part : parts) {
    for (const paper::ReproductionRow& r : part.rows) {
      rows.push_back({{"id", r.id},
                      {"case", r.case_name},
                      {"quantity", r.quantity},
                      {"unit", r.unit},
                      {"paper", r.paper},
                      {"measured", r.measured},
                      {"remark", r.remark}});
    }
  }
  return rows;
}

}  // namespace

int reproduce_command(const ReproduceOptions& options) {
  auto folder = OutputFolder::open(options.out);
  if (!folder) return refuse(options.json, exit_wrong_input, folder.error().text());
  Progress progress("reproducing the paper", options.quiet);
  const auto parts = paper::reproduce([&](double done) { progress.show(done, ""); });

  std::vector<std::string> pictures;
  if (options.plots) {
    pictures = draw_all(parts, *folder);
    if (auto page = folder->write("report.html", to_html(parts, pictures)); !page) {
      return fail(exit_failed, page.error().text());
    }
  }
  if (auto csv = folder->write("reproduction.csv", to_csv(parts)); !csv) {
    return fail(exit_failed, csv.error().text());
  }
  if (auto done = folder->commit(); !done) return fail(exit_failed, done.error().text());
  if (options.json) {
    print_results({{"folder", options.out}, {"rows", rows_of(parts)}});
  } else if (!options.quiet) {
    std::fputs(to_terminal(parts).c_str(), stdout);
    std::printf("\n%.1f s. Table: %s/reproduction.csv\n", progress.elapsed_s(),
                options.out.c_str());
    if (options.plots) std::printf("Page with plots: %s/report.html\n", options.out.c_str());
  }
  return exit_done;
}

}  // namespace supercoil::host_sim
