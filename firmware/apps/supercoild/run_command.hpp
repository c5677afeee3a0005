// supercoild, driving a board.
#pragma once

#include <string>

namespace supercoil::daemon {

struct RunOptions {
  std::string config = "/etc/supercoil/board.toml";
  std::string run_folder = "/run/supercoil";  ///< of the lock and the commands' socket
  int priority = 80;                          ///< of SCHED_FIFO; 0: ordinary threads
  int cpu = -1;                               ///< negative: any
};

/// Until SIGTERM, SIGINT or SIGHUP, which cool first. Returns the program's exit status.
int run_command(const RunOptions& options);

}  // namespace supercoil::daemon
