// With which frames a board is commanded over CAN, and how it answers.
#pragma once

#include <cstdint>
#include <optional>

#include "supercoil/hal/can_bus.hpp"

#include "loop/command.hpp"
#include "telemetry/leases.hpp"
#include "telemetry/settings.hpp"
#include "telemetry/unanswered.hpp"

namespace supercoil::telemetry {

/// Judges frames; neither sends nor receives. Every frame of a Command is either damaged, or
/// answered with a reason, or handed on; what is handed on is answered when the loop has done it.
/// Only disarm is obeyed from everybody; all else needs the lease.
class Commands {
 public:
  /// leases outlive it.
  Commands(const CanSettings& settings, Leases& leases);

  /// What became of a frame. All empty: it is no command to this board.
  struct Taken {
    std::optional<std::uint8_t> damaged;  ///< the channel whose command was damaged
    std::optional<Command> command;       ///< for the loop; its answer goes to answered()
    std::optional<hal::CanFrame> answer;
  };
  Taken take(const hal::CanFrame& frame, hal::Time now);

  /// The frame that answers a command that was handed on; empty: it was another's. Those that were
  /// handed on before it, and not answered, are no longer waited for.
  std::optional<hal::CanFrame> answered(const Answer& answer);

  /// The loop did not take the command that was handed on last.
  hal::CanFrame not_taken();

 private:
  /// As much of a command as its answer repeats.
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
