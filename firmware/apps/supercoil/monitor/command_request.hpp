// Command requests of a page, as JSON.
#pragma once

#include <cstdint>
#include <string>

#include "supercoil/hal/error.hpp"

#include "loop/command.hpp"

namespace supercoil::operating {

struct CommandRequest {
  std::uint8_t node;  ///< 1 to 63
  Verb verb;
  double value;
};

/// {"node":1,"opcode":"position","value":0.002}; value may be absent if the verb takes none. The
/// error says what is wrong, and with which value.
Result<CommandRequest> parse_command_request(const std::string& text);
/// {"node":1}
Result<std::uint8_t> parse_node(const std::string& text);

}  // namespace supercoil::operating
