// Frames as the codec that cantools generated packs them.
#pragma once

#include <cstdint>

#include "supercoil/hal/can_bus.hpp"

#include "can/e2e.hpp"

namespace supercoil::test {

/// id: of node 1. pack: the codec's.
template <class Signals>
hal::CanFrame packed(unsigned id, unsigned length, unsigned node, const Signals& signals,
                     int (*pack)(std::uint8_t*, const Signals*, std::size_t)) {
  hal::CanFrame frame;
  frame.id = static_cast<std::uint16_t>(id - 1U + node);
  frame.length = static_cast<std::uint8_t>(length);
  pack(frame.data.data(), &signals, frame.data.size());
  return frame;
}

/// The same, protected: the codec writes all but the checksum.
template <class Signals>
hal::CanFrame sealed(unsigned id, unsigned length, unsigned node, const Signals& signals,
                     int (*pack)(std::uint8_t*, const Signals*, std::size_t)) {
  hal::CanFrame frame = packed(id, length, node, signals, pack);
  can::e2e::protect(frame);
  return frame;
}

}  // namespace supercoil::test
