// Who may command over CAN, and with which frames.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <random>
#include <vector>

#include "supercoil/hal/can_bus.hpp"

#include "loop/command.hpp"
#include "telemetry/settings.hpp"

namespace supercoil::telemetry {

/// Identifiers of the frames that command a board's channels, for the bus's receive filters.
std::vector<std::uint16_t> command_ids(const CanSettings& settings, std::size_t channels);

/// Judges frames and keeps the leases, one a channel; neither sends nor receives. Every frame of a
/// Command is either damaged, or answered with a reason, or handed on; what is handed on is
/// answered when the loop has done it.
///
/// A lease is claimed, and granted with a session: a random number that every command must carry.
/// It ends when it is released or unused for lease_s; claiming it again under its session keeps it,
/// where there is nothing else to command. A session is never granted twice in a row, so
/// frames of an earlier one are refused. Only disarm is obeyed from everybody. This guards against
/// mistakes and faults, not against somebody who means harm: whoever can send can also stop.
class Commands {
 public:
  /// seed: of the sessions; on a board from a source of true randomness.
  Commands(const CanSettings& settings, std::size_t channels, std::uint32_t seed);

  /// What became of a frame. All empty: it is no command to this board.
  struct Taken {
    std::optional<std::uint8_t> damaged;  ///< the channel whose command was damaged
    std::optional<Command> command;       ///< for the loop; its answer goes to answered()
    std::optional<hal::CanFrame> answer;
  };
  Taken take(const hal::CanFrame& frame, hal::Time now);

  /// The frame that answers the oldest command that was handed on. Answers come in that order.
  std::optional<hal::CanFrame> answered(const Answer& answer);

  /// The loop did not take the command that was handed on last.
  hal::CanFrame not_taken();

  bool leased(std::uint8_t channel, hal::Time now) const;

 private:
  struct Lease {
    std::uint16_t session = 0;  ///< 0: nobody's
    std::uint16_t last_session = 0;
    std::uint16_t claimed_as = 0;  ///< what the claim carried as its session
    bool used = false;             ///< a command came since the claim
    std::uint8_t counter = 0;      ///< of the last frame
    hal::Time last{};
  };
  /// As much of a command as its answer repeats.
  struct Asked {
    std::uint8_t channel;
    std::uint8_t opcode;
    std::uint8_t counter;
    std::uint16_t session;
  };

  Refusal claim_lease(Lease& lease, const Asked& asked, hal::Time now);
  Refusal check(Lease& lease, const Asked& asked, float value, hal::Time now, bool& damaged);
  bool live(const Lease& lease, hal::Time now) const {
    return lease.session != 0 && now - lease.last <= lease_;
  }
  std::uint16_t new_session(const Lease& lease);
  hal::CanFrame acknowledge(const Asked& asked, Refusal refusal, std::uint16_t granted = 0) const;

  /// What the loop's ring of commands holds.
  static constexpr std::size_t most_waiting = 256;

  Node first_node_;
  hal::Duration lease_;
  std::vector<Lease> leases_;
  std::deque<Asked> waiting_;
  std::mt19937 random_;
};

}  // namespace supercoil::telemetry
