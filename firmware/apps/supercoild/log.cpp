#include "apps/supercoild/log.hpp"

#include <cstdio>
#include <cstdlib>

#include "apps/common/exit_status.hpp"

namespace supercoil::daemon {

namespace {

/// sd-daemon(3): syslog levels as line prefixes.
const char* journal_prefix(Level level) {
  switch (level) {
    case Level::problem:
      return "<3>";
    case Level::warning:
      return "<4>";
    case Level::info:
      break;
  }
  return "<6>";
}

const char* terminal_prefix(Level level) {
  switch (level) {
    case Level::problem:
      return "supercoild: problem: ";
    case Level::warning:
      return "supercoild: warning: ";
    case Level::info:
      break;
  }
  return "supercoild: ";
}

}  // namespace

void log(Level level, std::string_view text) {
  static const bool journal = std::getenv("JOURNAL_STREAM") != nullptr;
  std::fprintf(stderr, "%s%.*s\n", journal ? journal_prefix(level) : terminal_prefix(level),
               static_cast<int>(text.size()), text.data());
}

int fail(std::string_view why) {
  log(Level::problem, why);
  return exit_failed;
}

void log_steps(const std::vector<hal_linux::SetupStep>& steps) {
  for (const hal_linux::SetupStep& step : steps) {
    if (step.succeeded) {
      log(Level::info, step.step);
    } else {
      log(Level::warning, "not " + step.step + ": " + step.reason + "; " + step.remedy);
    }
  }
}

}  // namespace supercoil::daemon
