// `supercoild --check`: what a board's configuration says, without touching a device.
#pragma once

#include <string>

namespace supercoil::daemon {

/// Prints what was understood, with what the board has learned where it is this machine; as_json:
/// for programs. Answers the exit status.
int check_command(const std::string& file, bool as_json);

}  // namespace supercoil::daemon
