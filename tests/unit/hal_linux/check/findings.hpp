// Records the findings of a check.
#pragma once

#include <string>
#include <vector>

#include <CppUTest/TestHarness.h>

#include "supercoil/hal/board_check.hpp"

namespace supercoil::test {

struct CollectedFindings {
  std::vector<hal::Finding> findings;
  hal::FindingSink sink() {
    return [this](const hal::Finding& finding) { findings.push_back(finding); };
  }
};

/// found and remedy: parts of the texts; an empty remedy requires that there is none.
inline void check_finding(const std::string& severity, const std::string& found,
                          const std::string& remedy, const hal::Finding& finding) {
  STRCMP_EQUAL(severity.c_str(), hal::text(finding.severity));
  STRCMP_CONTAINS(found.c_str(), finding.found.c_str());
  STRCMP_CONTAINS(remedy.c_str(), finding.remedy.c_str());
  CHECK_EQUAL(remedy.empty(), finding.remedy.empty());
}

}  // namespace supercoil::test
