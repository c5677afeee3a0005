// Requests about the tuning of controllers on the commands' socket.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "loop/loop.hpp"

namespace supercoil::daemon {

/// "tuning CHANNEL PLACE TUNABLE SET" is answered with the value ("nan": not available); "prepare
/// CHANNEL PLACE TUNABLE VALUE" is answered like a command. TUNABLE is a name, or `all` with a
/// set's name as VALUE. Empty: the text is not a tuning request.
std::optional<std::string> answer_tuning_request(std::string_view text, Loop& loop);

}  // namespace supercoil::daemon
