// The signals of a frame as the generated codec unpacks them.
#pragma once

#include <CppUTest/TestHarness.h>

#include "supercoil/hal/can_bus.hpp"

namespace supercoil::test {

template <class Signals>
Signals unpacked(const hal::CanFrame& frame,
                 int (*unpack)(Signals*, const std::uint8_t*, std::size_t)) {
  Signals signals{};
  CHECK_EQUAL(0, unpack(&signals, frame.data.data(), frame.length));
  return signals;
}

}  // namespace supercoil::test
