// The frames that command a board over CAN, and the frames that answer them.
#pragma once

#include <cstdint>
#include <optional>

#include "supercoil/hal/can_bus.hpp"

#include "loop/command.hpp"
#include "telemetry/leases.hpp"
#include "telemetry/settings.hpp"
#include "telemetry/unanswered.hpp"

namespace supercoil::telemetry {

/// Checks frames; neither sends nor receives. Every Command frame is either damaged, or answered at
/// once, or passed to the loop and answered when the loop has done it. Only disarm is obeyed from
/// every master; everything else needs the lease.
class Commands {
 public:
  /// leases must outlive it.
  Commands(const CanSettings& settings, Leases& leases);

  /// The result of a frame. All empty: it is not a command to this board.
  struct Taken {
    std::optional<std::uint8_t> damaged;  ///< the channel whose command was damaged
    std::optional<Command> command;       ///< for the loop; its answer goes to answered()
    std::optional<hal::CanFrame> answer;
  };
  /// Any frame of the bus, in the order received.
  Taken take(const hal::CanFrame& frame, hal::Time now);

  /// The frame that answers a command that was passed to the loop; empty: the command came from
  /// elsewhere. Earlier commands without an answer are given up.
  std::optional<hal::CanFrame> answered(const Answer& answer);

  /// The answer when the loop did not take the command that was passed to it last.
  hal::CanFrame not_taken();

 private:
  /// The part of a command that its answer repeats.
  struct CommandHeader {
    std::uint8_t channel;
    std::uint8_t opcode;
    std::uint8_t counter;
    std::uint16_t session;
  };

  Refusal check(const CommandHeader& header, float value, hal::Time now);
  hal::CanFrame acknowledge(const CommandHeader& header, Refusal refusal,
                            std::uint16_t granted = 0) const;

  can::Node first_node_;
  Leases* leases_;
  Unanswered<CommandHeader> waiting_;
};

}  // namespace supercoil::telemetry
