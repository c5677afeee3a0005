// Numbers as text.
#pragma once

#include <array>
#include <charconv>
#include <cstdio>
#include <string>

namespace supercoil {

/// The shortest that gives the same number back.
template <class Number>
std::string shortest_text(Number number) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

/// For people, and for files that people read: with so many significant digits at most, without
/// zeros at the end.
inline std::string number_text(double value, int digits) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return text.data();
}

}  // namespace supercoil
