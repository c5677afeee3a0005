// What a daemon says: one line each, to the journal or a terminal.
#pragma once

#include <string_view>

namespace supercoil::daemon {

enum class Level { problem, warning, info };

/// To standard error, at once, from any thread. Under systemd each line carries its level.
void log(Level level, std::string_view text);

}  // namespace supercoil::daemon
