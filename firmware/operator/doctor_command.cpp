// supercoil doctor: looks at a board before anybody heats anything.
#include <cstdio>

#include "operator/commands.hpp"
#include "operator/doctor/check_board.hpp"
#include "operator/doctor/report.hpp"

namespace supercoil::operating {

int doctor_command(const DoctorOptions& options) {
  if (options.compare_senses) return compare_senses(options);
  const auto config = config::read_board_config(options.config);
  if (!config) {
    std::fputs(config::to_text(config.error()).c_str(), stderr);
    return exit_wrong_input;
  }
  doctor::Report report{config->name, options.config, {}};
  const doctor::CheckOptions check{
      {}, {options.priority, options.cpu}, options.run_folder, options.can};
  doctor::check_board(*config, check, [&](const hal::Finding& finding) {
    report.findings.push_back(finding);
    // As it comes: a device that hangs is the one after the last line.
    if (options.json) return;
    std::fputs(doctor::to_text(finding).c_str(), stdout);
    std::fflush(stdout);
  });
  if (options.json) {
    std::fputs(doctor::to_json(report).c_str(), stdout);
  } else {
    std::printf("%s: %s\n", report.board.c_str(), doctor::summary(report).c_str());
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    return fail(exit_failed, "cannot write to standard output");
  }
  return report.count(hal::Verdict::problem) == 0 ? exit_done : exit_failed;
}

}  // namespace supercoil::operating
