// Random frames.
#pragma once

#include <rapidcheck.h>

#include "supercoil/hal/can_bus.hpp"

namespace supercoil::test {

/// All bits set, none, only the sign bit, all but the sign bit: the raw values at the ends of
/// ranges consist of these bytes.
inline rc::Gen<std::uint8_t> extreme_byte() {
  return rc::gen::weightedOneOf<std::uint8_t>(
      {{1, rc::gen::element<std::uint8_t>(0x00, 0xFF, 0x80, 0x7F)},
       {1, rc::gen::inRange<std::uint8_t>(0, 0xFF)}});
}

/// Bytes beyond the frame's length are 0, as in a frame that was read.
inline hal::CanFrame any_frame() {
  hal::CanFrame frame;
  frame.id = *rc::gen::inRange<std::uint16_t>(0, 0x800);
  frame.length = *rc::gen::inRange<std::uint8_t>(0, 9);
  for (std::size_t i = 0; i < frame.length; ++i)
    frame.data.at(i) = *extreme_byte();
  return frame;
}

inline bool same(const hal::CanFrame& a, const hal::CanFrame& b) {
  return a.id == b.id && a.length == b.length && a.data == b.data && a.received == b.received;
}

}  // namespace supercoil::test
