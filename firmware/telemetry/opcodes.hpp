// What can be asked for over CAN: every verb of the loop, and the lease.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "loop/command.hpp"

namespace supercoil::telemetry {

/// Of firmware/telemetry/supercoil.dbc; a change that an old reader would misunderstand gives a new
/// number.
inline constexpr std::uint8_t protocol_version = 3;

/// A verb has its own number; the lease's follow.
enum Opcode : std::uint8_t { claim = verb_names.size(), release };

inline constexpr std::size_t opcodes = verb_names.size() + 2;
static_assert(opcodes == 16, "an opcode has 4 bits, and each means something");

constexpr std::array<std::string_view, opcodes> opcode_names() {
  std::array<std::string_view, opcodes> names{};
  for (std::size_t i = 0; i < verb_names.size(); ++i)
    names[i] = verb_names[i];
  names[claim] = "claim";
  names[release] = "release";
  return names;
}

}  // namespace supercoil::telemetry
