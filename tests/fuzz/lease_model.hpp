// Who may command, derived independently from the frames on the bus alone; the firmware is compared
// with it.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>

#include <supercoil.h>

#include "supercoil/hal/can_bus.hpp"

#include "fuzz/fuzz.hpp"
#include "telemetry/opcodes.hpp"

namespace supercoil::fuzz {

/// CRC-8H2F as AUTOSAR describes it, bit by bit. behind: bytes that follow the data id.
inline std::uint8_t crc_of(const hal::CanFrame& frame,
                           std::initializer_list<unsigned> behind = {}) {
  unsigned crc = 0xFF;
  const auto add = [&](unsigned byte) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit)
      crc = ((crc & 0x80U) != 0 ? (crc << 1U) ^ 0x2FU : crc << 1U) & 0xFFU;
  };
  for (std::size_t i = 1; i < frame.length; ++i)
    add(frame.data[i]);
  add(frame.id & 0xFFU);
  for (const unsigned byte : behind)
    add(byte);
  return static_cast<std::uint8_t>(crc ^ 0xFFU);
}

class LeaseModel {
 public:
  static constexpr int channels = 2;
  static constexpr unsigned command_base = 0x200;
  static constexpr unsigned acknowledge_base = 0x240;
  static constexpr unsigned knot_base = 0x100;
  static constexpr unsigned play_base = 0x140;
  static constexpr int first_node = 1;

  struct Lease {
    std::uint16_t session = 0;  ///< 0: none was granted
    std::uint8_t counter = 0;
    hal::Time last{};
  };

  explicit LeaseModel(double lease_s) : lease_(hal::duration_from(lease_s)) {}

  /// Counted from 0; -1: the frame is for another node. base: the base identifier of its message.
  static int channel_of(const hal::CanFrame& frame, unsigned base = command_base) {
    const int channel = frame.id - static_cast<int>(base) - first_node;
    return channel >= 0 && channel < channels ? channel : -1;
  }
  /// The channel that a trajectory frame moves, according to the session it carries; -1: none.
  int moves(const hal::CanFrame& frame) const {
    const int knot = channel_of(frame, knot_base);
    if (knot >= 0) return frame.data[0] == knot_crc(frame, knot) ? knot : -1;
    const int play = channel_of(frame, play_base);
    const bool ours =
        play >= 0 && frame.data[0] == crc_of(frame) &&
        (frame.data[2] | static_cast<unsigned>(frame.data[3]) << 8U) == lease(play).session;
    return ours ? play : -1;
  }
  std::uint8_t knot_crc(const hal::CanFrame& frame, int channel) const {
    const unsigned session = lease(channel).session;
    return crc_of(frame, {session & 0xFFU, session >> 8U});
  }
  static bool intact(const hal::CanFrame& frame) {
    return frame.length == SUPERCOIL_COMMAND_LENGTH && frame.data[0] == crc_of(frame);
  }
  static supercoil_command_t command_in(const hal::CanFrame& frame) {
    supercoil_command_t m{};
    supercoil_command_unpack(&m, frame.data.data(), frame.length);
    return m;
  }
  /// A disarm is obeyed from any node.
  static bool stops(const supercoil_command_t& m) {
    return m.opcode == static_cast<std::uint8_t>(Verb::disarm) && m.value == 0.0F;
  }
  /// The frame is from the lease holder, and its lease has not expired.
  bool from_holder(const hal::CanFrame& frame, hal::Time now) const {
    const int channel = channel_of(frame);
    if (channel < 0 || !intact(frame)) return false;
    const Lease& lease = leases_[static_cast<std::size_t>(channel)];
    return lease.session != 0 && command_in(frame).session == lease.session &&
           now - lease.last <= lease_;
  }
  /// At most three of its frames were lost before this one.
  bool in_sequence(const hal::CanFrame& frame) const {
    const unsigned ahead = (command_in(frame).counter - lease_of(frame).counter) & 15U;
    return ahead >= 1 && ahead <= 4;
  }
  const Lease& lease_of(const hal::CanFrame& frame) const {
    return leases_[static_cast<std::size_t>(channel_of(frame))];
  }
  /// The nonce that the board last sent.
  std::uint16_t nonce_of(const hal::CanFrame& frame) const {
    return nonces_[static_cast<std::size_t>(channel_of(frame))];
  }
  const Lease& lease(int channel) const { return leases_[static_cast<std::size_t>(channel)]; }

  /// After each judged frame: updates the holder's counter and, if in_sequence, renews the lease.
  void observe(const hal::CanFrame& frame, hal::Time now) {
    if (!from_holder(frame, now)) return;
    Lease& lease = leases_[static_cast<std::size_t>(channel_of(frame))];
    if (in_sequence(frame)) lease.last = now;
    lease.counter = command_in(frame).counter;
  }
  /// The same for a trajectory frame; returns the channel that it moves, -1: none.
  int observe_trajectory(const hal::CanFrame& frame, hal::Time now) {
    const int moved = moves(frame);
    if (moved < 0) return moved;
    Lease& lease = leases_[static_cast<std::size_t>(moved)];
    const bool live = lease.session != 0 && now - lease.last <= lease_;
    const unsigned counter = frame.data[1] & 15U;
    const unsigned ahead = (counter - lease.counter) & 15U;
    if (live && ahead >= 1 && ahead <= 4) lease.last = now;
    if (live) lease.counter = static_cast<std::uint8_t>(counter);
    return moved;
  }
  /// An answer of the board: it grants a lease or reports that one was released.
  void observe_answer(const hal::CanFrame& frame, hal::Time now) {
    const int channel = frame.id - static_cast<int>(acknowledge_base) - first_node;
    if (channel < 0 || channel >= channels || frame.length != SUPERCOIL_ACKNOWLEDGE_LENGTH) return;
    require(frame.data[0] == crc_of(frame), "answers are protected");
    supercoil_acknowledge_t m{};
    supercoil_acknowledge_unpack(&m, frame.data.data(), frame.length);
    const bool again = m.refusal == static_cast<std::uint8_t>(Refusal::claim_again);
    if (again) nonces_[static_cast<std::size_t>(channel)] = m.granted;
    if (m.refusal != static_cast<std::uint8_t>(Refusal::none)) return;
    Lease& lease = leases_[static_cast<std::size_t>(channel)];
    if (m.opcode != telemetry::Opcode::lease) return;
    // Giving a lease back grants nothing.
    lease = m.granted != 0 ? Lease{m.granted, m.counter, now} : Lease{};
  }

 private:
  hal::Duration lease_;
  std::array<Lease, channels> leases_{};
  std::array<std::uint16_t, channels> nonces_{};
};

}  // namespace supercoil::fuzz
