// Numbers as text.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>

namespace supercoil {

/// The shortest text that reads back as the same number.
template <class Number>
std::string shortest_text(Number number) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

/// For people, and for files that people read: at most this many significant digits, no trailing
/// zeros. 1480 in three digits is "1480"; from ten million on there is an exponent.
inline std::string number_text(double value, int digits) {
  constexpr double first_with_exponent = 1e7;
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  double rounded = 0.0;
  const std::string_view shown(text.data());
  if (shown.find("e+") == std::string_view::npos) return text.data();
  std::from_chars(shown.data(), shown.data() + shown.size(), rounded);
  if (std::abs(rounded) < first_with_exponent)
    std::snprintf(text.data(), text.size(), "%.0f", rounded);
  return text.data();
}

}  // namespace supercoil
