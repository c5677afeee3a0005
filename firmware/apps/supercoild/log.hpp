// The daemon's log: one line per message, to the journal or a terminal.
#pragma once

#include <string_view>
#include <vector>

#include "supercoil/hal_linux/realtime.hpp"

namespace supercoil::daemon {

enum class Level { problem, warning, info };

/// Writes to standard error at once, from any thread. Under systemd each line carries its level.
void log(Level level, std::string_view text);

/// Logs why the program ends, and returns the status for that: exit_failed.
int fail(std::string_view why);

/// Logs the real-time set-up steps that worked; warns of failed ones, with their remedies.
void log_steps(const std::vector<hal_linux::SetupStep>& steps);

}  // namespace supercoil::daemon
