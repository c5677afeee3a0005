// What a daemon says: one line each, to the journal or a terminal.
#pragma once

#include <string_view>
#include <vector>

#include "supercoil/hal_linux/realtime.hpp"

namespace supercoil::daemon {

enum class Level { problem, warning, info };

/// To standard error, at once, from any thread. Under systemd each line carries its level.
void log(Level level, std::string_view text);

/// Says why the program ends, and gives the status for that: exit_failed.
int fail(std::string_view why);

/// What worked of the real-time set-up, and as warnings what did not, with its remedy.
void log_steps(const std::vector<hal_linux::SetupStep>& steps);

}  // namespace supercoil::daemon
