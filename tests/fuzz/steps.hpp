// Decodes a fuzz input into frames that reach a board, and the time to wait at each.
#pragma once

#include <array>
#include <cstring>

#include "fuzz/lease_model.hpp"

namespace supercoil::fuzz {

/// The layout of a step in an input; tests/fuzz/seeds.py writes the same.
struct Step {
  static constexpr std::uint8_t to_channel = 1;    ///< id: one of this board's channels
  static constexpr std::uint8_t with_session = 2;  ///< the session of the lease
  static constexpr std::uint8_t with_counter = 4;  ///< the next counter
  static constexpr std::uint8_t sealed = 8;        ///< with the right CRC; chance finds 1 in 256
  static constexpr std::uint8_t whole = 16;        ///< 8 bytes long
  static constexpr std::uint8_t with_nonce = 32;   ///< its value is the board's last nonce
  static constexpr std::uint8_t knot = 64;         ///< with to_channel: a knot, not a command
  static constexpr std::uint8_t play = 128;        ///< with to_channel: Play, not a command

  std::uint8_t how;
  std::uint8_t wait;
  std::array<std::uint8_t, 2> id;
  std::array<std::uint8_t, 8> data;
};
static_assert(sizeof(Step) == 12);

/// Calls use(step) for each step of an input.
template <class Use>
void for_each_step(const std::uint8_t* data, std::size_t size, Use use) {
  for (; size >= sizeof(Step); data += sizeof(Step), size -= sizeof(Step)) {
    Step step{};
    std::memcpy(&step, data, sizeof(Step));
    use(step);
  }
}

/// The frame of a step, as sent by a node that hears everything on the bus.
inline hal::CanFrame frame_of(const Step& step, const LeaseModel& model) {
  hal::CanFrame frame;
  frame.id =
      static_cast<std::uint16_t>((step.id[0] | static_cast<unsigned>(step.id[1]) << 8U) & 0x7FFU);
  frame.length = static_cast<std::uint8_t>(step.id[1] >> 4U) % 9;
  frame.data = step.data;
  if ((step.how & Step::whole) != 0) frame.length = SUPERCOIL_COMMAND_LENGTH;
  if ((step.how & Step::to_channel) != 0) {
    frame.id = static_cast<std::uint16_t>(LeaseModel::command_base + LeaseModel::first_node +
                                          step.id[0] % LeaseModel::channels);
    const LeaseModel::Lease& lease = model.lease_of(frame);
    if ((step.how & Step::with_session) != 0) {
      frame.data[2] = static_cast<std::uint8_t>(lease.session & 0xFFU);
      frame.data[3] = static_cast<std::uint8_t>(lease.session >> 8U);
    }
    if ((step.how & Step::with_nonce) != 0) {
      const auto nonce = static_cast<float>(model.nonce_of(frame));
      std::memcpy(&frame.data[4], &nonce, sizeof(nonce));
    }
    if ((step.how & Step::with_counter) != 0) {
      const unsigned next = (lease.counter + 1U) & 15U;
      frame.data[1] = static_cast<std::uint8_t>((frame.data[1] & 0xF0U) | next);
    }
  }
  const int channel = LeaseModel::channel_of(frame);
  const bool is_knot = (step.how & Step::knot) != 0 && channel >= 0;
  const bool is_play = !is_knot && (step.how & Step::play) != 0 && channel >= 0;
  if (is_knot || is_play) {
    const unsigned base = is_knot ? LeaseModel::knot_base : LeaseModel::play_base;
    frame.id = static_cast<std::uint16_t>(frame.id - LeaseModel::command_base + base);
  }
  if ((step.how & Step::sealed) != 0 && frame.length > 0)
    frame.data[0] = is_knot ? model.knot_crc(frame, channel) : crc_of(frame);
  return frame;
}

}  // namespace supercoil::fuzz
