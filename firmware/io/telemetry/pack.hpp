// From quantities to the raw values of signals, and from messages to frames.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "supercoil/hal/can_bus.hpp"

#include "telemetry/e2e.hpp"
#include "telemetry/nodes.hpp"

namespace supercoil::telemetry {

/// The raw value of a scaled signal. not_available: the one that the DBC reserves, the least of a
/// signed and the largest of an unsigned signal; all others are its range. The functions are the
/// codec's own, so that the scale stands in the DBC alone.
template <class Raw>
Raw scaled(double value, std::type_identity_t<Raw> not_available, Raw (*encode)(double),
           double (*decode)(Raw)) {
  if (std::isnan(value)) return not_available;
  const auto reserved = static_cast<std::int64_t>(not_available);
  const auto highest = static_cast<Raw>(std::is_signed_v<Raw> ? -(reserved + 1) : reserved - 1);
  const auto lowest = static_cast<Raw>(std::is_signed_v<Raw> ? reserved + 1 : 0);
  if (value >= decode(highest)) return highest;
  if (value <= decode(lowest)) return lowest;
  return encode(value);
}

/// id: of node 1. pack: the codec's.
template <class Signals>
hal::CanFrame packed(unsigned id, unsigned length, Node node, const Signals& signals,
                     int (*pack)(std::uint8_t*, const Signals*, std::size_t)) {
  hal::CanFrame frame;
  frame.id = id_of(id, node);
  frame.length = static_cast<std::uint8_t>(length);
  pack(frame.data.data(), &signals, frame.data.size());
  return frame;
}

/// The same, protected: the codec wrote all but the checksum.
template <class Signals>
hal::CanFrame sealed(unsigned id, unsigned length, Node node, const Signals& signals,
                     int (*pack)(std::uint8_t*, const Signals*, std::size_t)) {
  hal::CanFrame frame = packed(id, length, node, signals, pack);
  e2e::protect(frame);
  return frame;
}

}  // namespace supercoil::telemetry
