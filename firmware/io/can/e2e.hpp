// AUTOSAR E2E Profile 2: the receiver detects a damaged, repeated or lost frame.
#pragma once

#include <cstdint>

#include <boost/crc.hpp>

#include "supercoil/hal/can_bus.hpp"

namespace supercoil::can::e2e {

/// Byte 0 of the frame: CRC-8H2F over all other bytes and then the data id. All 16 data ids are the
/// low byte of the frame's identifier, so a frame that reaches another node counts as damaged.
/// Messages whose identifiers differ by a multiple of 0x100 have the same data ids.
///
/// Not Profile 1: its CRC-8 of SAE J1850 misses 198 of the 41664 possible 3-bit errors in 8 bytes,
/// this one none (counted on 2026-11-21; commands_test tries them all).
inline auto unfinished_crc(const hal::CanFrame& frame) {
  boost::crc_optimal<8, 0x2F, 0xFF, 0xFF, false, false> crc;
  crc.process_bytes(frame.data.data() + 1, frame.length - 1U);
  crc.process_byte(static_cast<std::uint8_t>(frame.id));
  return crc;
}
/// For a frame that carries its session, or needs none.
inline std::uint8_t crc(const hal::CanFrame& frame) {
  return unfinished_crc(frame).checksum();
}
/// For a frame without room for its session: the session follows the data id, low byte first.
inline std::uint8_t crc(const hal::CanFrame& frame, std::uint16_t session) {
  auto crc = unfinished_crc(frame);
  crc.process_byte(static_cast<std::uint8_t>(session));
  crc.process_byte(static_cast<std::uint8_t>(session >> 8U));
  return crc.checksum();
}

/// session: only for a frame that has no room for it.
template <class... Session>
void protect(hal::CanFrame& frame, Session... session) {
  frame.data[0] = crc(frame, session...);
}
/// length: the message's, 1 to 8.
template <class... Session>
bool intact(const hal::CanFrame& frame, std::uint8_t length, Session... session) {
  return frame.length == length && frame.data[0] == crc(frame, session...);
}

/// Counters run from 0 to 15.
inline constexpr std::uint8_t counters = 16;
/// Consecutive frames that may be lost without breaking the sequence.
inline constexpr std::uint8_t max_lost = 3;

/// Whether a frame is the next one, allowing for max_lost lost frames. This detects a frame that is
/// repeated while fewer than 12 came after it. It does not detect one repeated 12 to 15 frames
/// later, modulo 16, nor 16 recorded frames replayed in order: a session and its lease bound how
/// long these can pass (Leases), and a recorded claim brings neither back.
constexpr bool follows(std::uint8_t counter, std::uint8_t last) {
  const int ahead = (counter - last + counters) % counters;
  return ahead >= 1 && ahead <= max_lost + 1;
}

}  // namespace supercoil::can::e2e
