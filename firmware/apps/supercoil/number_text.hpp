// Numbers for people, and for files that people read.
#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace supercoil::operating {

/// With so many significant digits at most, without zeros at the end.
inline std::string number_text(double value, int digits) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return text.data();
}

}  // namespace supercoil::operating
