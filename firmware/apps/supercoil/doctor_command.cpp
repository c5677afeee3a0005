// supercoil doctor: checks a board before anything is heated.
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "apps/supercoil/commands.hpp"
#include "apps/supercoil/doctor/check_board.hpp"
#include "apps/supercoil/doctor/report.hpp"
#include "text/documentation.hpp"

namespace supercoil::operating {

namespace {

/// Whether the board's file does not exist yet. A file that is named must exist.
bool unconfigured(const DoctorOptions& options) {
  std::error_code error;
  return options.config == DoctorOptions().config &&
         !std::filesystem::exists(options.config, error) && !error;
}

/// Prints each finding as it comes: a device that hangs is the one after the last line.
hal::FindingSink sink_of(doctor::Report& report, bool json) {
  return [&report, json](const hal::Finding& finding) {
    report.findings.push_back(finding);
    if (json) return;
    std::fputs(doctor::to_text(finding).c_str(), stdout);
    std::fflush(stdout);
  };
}

int conclude(const doctor::Report& report, bool json) {
  if (json) {
    std::fputs(doctor::to_json(report).c_str(), stdout);
  } else {
    std::printf("%s: %s\n", report.board.c_str(), doctor::summary(report).c_str());
  }
  return report.count(hal::Severity::problem) == 0 ? exit_done : exit_failed;
}

}  // namespace

int doctor_command(const DoctorOptions& options) {
  if (options.compare_senses) return compare_senses(options);
  const doctor::CheckOptions check{
      {}, {options.priority, options.cpu}, options.run_folder, options.can};
  if (unconfigured(options)) {
    doctor::Report report{"this machine", options.config, {}};
    const hal::FindingSink sink = sink_of(report, options.json);
    doctor::check_machine(check, sink);
    sink({"configuration", hal::Severity::problem,
          "none: " + options.config + ": there is no such file",
          "copy the closest example from /etc/supercoil/boards (in the sources: "
          "firmware/io/config/examples) to that path and correct it (every key is explained by " +
              documentation_page("configuration") + "); or name another file with --config"});
    return conclude(report, options.json);
  }
  const auto config = config::read_board_config(options.config);
  if (!config) {
    const std::string why = config::to_text(config.error());
    if (options.json) print_error(why);
    std::fputs(why.c_str(), stderr);
    return exit_wrong_input;
  }
  doctor::Report report{config->name, options.config, {}};
  doctor::check_board(*config, check, sink_of(report, options.json));
  return conclude(report, options.json);
}

}  // namespace supercoil::operating
