// What a page asks for, as JSON.
#pragma once

#include <cstdint>
#include <string>

#include <tl/expected.hpp>

#include "loop/command.hpp"

namespace supercoil::operating {

struct CommandRequest {
  std::uint8_t node;  ///< 1 to 63
  Verb verb;
  double value;
};

/// {"node":1,"opcode":"position","value":0.002}; value may be absent where the verb has none. The
/// error says what is wrong, and with what.
tl::expected<CommandRequest, std::string> parse_command_request(const std::string& text);
/// {"node":1}
tl::expected<std::uint8_t, std::string> parse_node(const std::string& text);

}  // namespace supercoil::operating
