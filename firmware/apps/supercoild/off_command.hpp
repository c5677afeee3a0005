// Everything off, for when supercoild did not end by itself.
#pragma once

#include <string>

namespace supercoil::daemon {

/// Sets every line of the board low and every duty to 0, also when some devices cannot be had;
/// those are named. Refused while supercoild runs: it has the devices, and makes them safe itself.
/// Returns an exit status.
int off_command(const std::string& config, const std::string& run_folder);

}  // namespace supercoil::daemon
