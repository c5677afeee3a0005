#include <filesystem>

#include <nlohmann/json.hpp>

#include "apps/supercoil/doctor/check_board.hpp"
#include "apps/supercoil/doctor/report.hpp"
#include "apps/supercoil/setup/file_steps.hpp"
#include "text/documentation.hpp"

namespace supercoil::operating {

namespace {

using Json = nlohmann::ordered_json;

}  // namespace

StepResult doctor_step(const SetupOptions& options, const config::BoardConfig& config,
                       Operator& user) {
  if (!options.can.empty()) {
    const bool simulated = options.can.starts_with("socketcand:");
    user.show("the board is reached over " + options.can + ", and is " +
              (simulated ? "simulated, or another machine" : "possibly another machine") +
              ": doctor checks the machine on which it runs, so run supercoil doctor on the board "
              "itself; nothing was checked here");
    return Json{{"looked_at", nullptr}};
  }
  doctor::CheckOptions check;
  check.run_folder = std::filesystem::path(options.socket).parent_path().string();
  doctor::Report report{config.name, options.config, {}};
  doctor::check_board(config, check, [&](const hal::Finding& finding) {
    report.findings.push_back(finding);
    if (finding.severity == hal::Severity::ok) return;
    user.show(std::string(hal::text(finding.severity)) + ": " + finding.what + ": " +
              finding.found);
    if (!finding.remedy.empty()) user.show("what to do: " + finding.remedy);
  });
  const auto problems = report.count(hal::Severity::problem);
  user.show(doctor::summary(report) + (problems > 0
                                           ? "; fix all problems before anything is heated (see " +
                                                 documentation_page("doctor") + ")"
                                           : ""));
  return Json{{"looked_at", config.name},
              {"problems", problems},
              {"warnings", report.count(hal::Severity::warning)},
              {"in_order", report.count(hal::Severity::ok)}};
}

}  // namespace supercoil::operating
