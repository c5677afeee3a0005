// Findings of doctor, for people and for programs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "supercoil/hal/board_check.hpp"

namespace supercoil::doctor {

/// Findings in the order in which they were made.
struct Report {
  std::string board;   ///< its name
  std::string config;  ///< path of its configuration
  std::vector<hal::Finding> findings;

  std::int64_t count(hal::Severity severity) const;
};

/// One finding: verdict, subject, state; below it the remedy.
std::string to_text(const hal::Finding& finding);
/// "1 problem, 2 warnings, 20 in order".
std::string summary(const Report& report);
/// One object; docs/doctor.md describes it.
std::string to_json(const Report& report);

}  // namespace supercoil::doctor
