// What must hold for the mistakes found in any file.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "config/diagnostics.hpp"
#include "fuzz/fuzz.hpp"

namespace supercoil::fuzz {

inline void require_named(const Errors& problems, std::string_view file, std::string_view text) {
  require(!problems.empty(), "what is refused is refused with a reason");
  const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
  for (const Error& problem : problems) {
    require(problem.file == file, "every mistake names its file");
    require(problem.line >= 0 && problem.line <= lines, "its line is one of the file's");
    require(!problem.message.empty(), "it says what is wrong");
  }
}

}  // namespace supercoil::fuzz
