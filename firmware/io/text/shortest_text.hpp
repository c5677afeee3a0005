// Numbers as text.
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace supercoil {

/// The shortest that gives the same number back.
template <class Number>
std::string shortest_text(Number number) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

}  // namespace supercoil
