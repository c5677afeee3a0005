// What is read from a board's text, and the problems that are reported for a wrong one.
#pragma once

#include <string>

#include <CppUTest/TestHarness.h>

#include "unit/firmware/io/config/support/small_board.hpp"

namespace supercoil::test {

/// expected: without the final line break.
inline void check_problems(const std::string& expected, const std::string& text) {
  STRCMP_EQUAL((expected + "\n").c_str(), problems_of(text).c_str());
}

/// The small board with a part of it replaced.
inline void check_replaced(const std::string& old, const std::string& replacement,
                           const std::string& expected) {
  check_problems(expected, small_board_with(old, replacement));
}

inline config::BoardConfig read_board(const std::string& text) {
  const auto config = config::parse_board_config(text, "b.toml");
  CHECK_TEXT(config.has_value(), config ? "" : config::to_text(config.error()).c_str());
  return config.value();
}

/// part: of the problems in the board's text.
inline void check_answer(const std::string& part, const std::string& text) {
  STRCMP_CONTAINS(part.c_str(), problems_of(text).c_str());
}

}  // namespace supercoil::test
