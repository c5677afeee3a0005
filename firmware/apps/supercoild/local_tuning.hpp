// Requests of the commands' socket about the tuning of controllers.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "loop/loop.hpp"

namespace supercoil::daemon {

/// "tuning CHANNEL PLACE TUNABLE SET" is answered with the value ("nan": there is none), "prepare
/// CHANNEL PLACE TUNABLE VALUE" as a command is. TUNABLE is a name, or `all` with a set's name as
/// VALUE. Empty: the text is no such request.
std::optional<std::string> answer_about_tuning(std::string_view text, Loop& loop);

}  // namespace supercoil::daemon
