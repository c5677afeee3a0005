// Compares the statuses of calls by their text.
#pragma once

#include <CppUTest/TestHarness.h>

#include "supercoil/hal/status.hpp"

namespace supercoil::test {

inline void check_status(hal::Status expected, hal::Status status) {
  STRCMP_EQUAL(hal::text(expected), hal::text(status));
}

}  // namespace supercoil::test
