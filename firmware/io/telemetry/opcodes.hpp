// What can be asked for over CAN: every verb of the loop, and the lease.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

#include "loop/command.hpp"

namespace supercoil::telemetry {

/// Version of firmware/io/can/supercoil.dbc; a change that an old reader would misunderstand gets a
/// new number.
inline constexpr std::uint8_t protocol_version = 5;

/// An opcode has 4 bits, and every value is used. A verb's opcode is its own number, except for the
/// verbs that compare with a meter or a thermometer: they share one that is no verb's, and the
/// value tells them apart. Up to version 3 claim was 14, and release 15 with value 0.
enum Opcode : std::uint8_t { compare = 0, claim_of_version_3 = 14, lease = 15 };

/// Values of a lease command, besides the nonce that claim_again gave.
inline constexpr float claim_value = 0.0F;
inline constexpr float release_value = -1.0F;

inline constexpr std::size_t opcodes = 16;

/// A rise of 0 K is sent as this value; no supply has that many volts.
inline constexpr double rise_offset = 1000.0;

/// Verb::tune is sent as `controller`, with this added to the controller's place.
inline constexpr double tune_offset = 1000.0;

/// A command as it is sent.
struct EncodedCommand {
  std::uint8_t opcode;
  double value;
};
/// A value that the opcode cannot carry becomes NaN, which the board refuses.
constexpr EncodedCommand encode_command(Verb verb, double value) {
  // A meter's value with the wrong sign must not be taken for the other sense's.
  constexpr double invalid = std::numeric_limits<double>::quiet_NaN();
  if (verb == Verb::compare_supply) {
    const bool volts = value >= 0.0 && value < rise_offset;
    return {compare, volts ? value : invalid};
  }
  if (verb == Verb::compare_current) return {compare, value > 0.0 ? -value : invalid};
  if (verb == Verb::compare_rise) return {compare, value >= 0.0 ? rise_offset + value : invalid};
  if (verb == Verb::tune) {
    return {static_cast<std::uint8_t>(Verb::controller),
            value >= 0.0 ? tune_offset + value : invalid};
  }
  return {static_cast<std::uint8_t>(verb), value};
}
/// The command that was sent; opcode: not the lease's. NaN is not taken for a current.
constexpr Command decode_command(std::uint8_t opcode, double value) {
  if (opcode == static_cast<std::uint8_t>(Verb::controller) && value >= tune_offset)
    return {0, Verb::tune, value - tune_offset};
  if (opcode != compare) return {0, static_cast<Verb>(opcode), value};
  if (value >= rise_offset) return {0, Verb::compare_rise, value - rise_offset};
  return value < 0.0 ? Command{0, Verb::compare_current, -value}
                     : Command{0, Verb::compare_supply, value};
}

/// By opcode, as in the DBC.
constexpr std::array<std::string_view, opcodes> opcode_names() {
  std::array<std::string_view, opcodes> names{};
  for (std::size_t i = 0; i < claim_of_version_3; ++i)
    names[i] = verb_names[i];
  names[compare] = "compare";
  names[claim_of_version_3] = "claim_of_version_3";
  names[lease] = "lease";
  return names;
}

}  // namespace supercoil::telemetry
