#include "apps/supercoil/doctor/report.hpp"

#include <algorithm>
#include <cstdint>

#include <nlohmann/json.hpp>

namespace supercoil::doctor {

using hal::Finding;
using hal::Severity;

namespace {

std::string counted(std::int64_t count, const std::string& one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

}  // namespace

std::int64_t Report::count(Severity severity) const {
  return std::count_if(findings.begin(), findings.end(),
                       [&](const Finding& finding) { return finding.severity == severity; });
}

std::string to_text(const Finding& finding) {
  constexpr std::size_t severity_width = 9;
  constexpr std::size_t what_width = 26;
  const std::string indent(severity_width, ' ');
  std::string line = padded(hal::text(finding.severity), severity_width) +
                     padded(finding.what + " ", what_width) + finding.found + "\n";
  if (!finding.remedy.empty()) line += indent + "what to do: " + finding.remedy + "\n";
  return line;
}

std::string summary(const Report& report) {
  return counted(report.count(Severity::problem), "problem") + ", " +
         counted(report.count(Severity::warning), "warning") + ", " +
         std::to_string(report.count(Severity::ok)) + " in order";
}

std::string to_json(const Report& report) {
  using nlohmann::ordered_json;
  ordered_json findings = ordered_json::array();
  for (const Finding& f : report.findings) {
    findings.push_back({{"what", f.what},
                        {"severity", hal::text(f.severity)},
                        {"found", f.found},
                        {"remedy", f.remedy}});
  }
  const ordered_json all{{"board", report.board},
                         {"config", report.config},
                         {"problems", report.count(Severity::problem)},
                         {"warnings", report.count(Severity::warning)},
                         {"findings", findings}};
  // A device's name may contain bytes that are not valid text.
  return all.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace supercoil::doctor
