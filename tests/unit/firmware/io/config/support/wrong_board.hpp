// What a board's mistaken text is answered, whole.
#pragma once

#include <string>

#include <CppUTest/TestHarness.h>

#include "unit/firmware/io/config/support/small_board.hpp"

namespace supercoil::test {

/// expected: without the last line's end.
inline void check_problems(const std::string& expected, const std::string& text) {
  STRCMP_EQUAL((expected + "\n").c_str(), problems_of(text).c_str());
}

/// The small board with a part of it replaced.
inline void check_replaced(const std::string& old, const std::string& replacement,
                           const std::string& expected) {
  check_problems(expected, small_board_with(old, replacement));
}

}  // namespace supercoil::test
