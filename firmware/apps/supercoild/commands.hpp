// Commands of supercoild; each returns the program's exit status.
#pragma once

#include <cstdint>
#include <string>

namespace supercoil::daemon {

struct RunOptions {
  std::string config = "/etc/supercoil/board.toml";
  std::string run_folder = "/run/supercoil";  ///< holds the lock and the commands' socket
  int priority = 80;                          ///< SCHED_FIFO priority; 0: ordinary threads
  int cpu = -1;                               ///< negative: any
};

/// Runs until SIGTERM, SIGINT or SIGHUP, then cools the muscles. Returns the program's exit status.
int run_command(const RunOptions& options);

/// Sets every line of the board low and every duty to 0, even if some devices cannot be opened;
/// those are named. Refused while supercoild runs: it owns the devices, and makes them safe itself.
/// Returns an exit status.
int off_command(const std::string& config, const std::string& run_folder);

/// Prints what was understood, including what the board has learned if this machine is that board.
/// as_json: for programs. Returns the exit status.
int check_command(const std::string& file, bool as_json);

/// Prints every key that applies to the file. Returns the exit status.
int keys_command(const std::string& file, bool as_json);

struct LatencyOptions {
  std::string config;       ///< empty: one channel at rate_Hz
  double rate_Hz = 1000.0;  ///< 100 to 10000
  double seconds = 10.0;    ///< duration of the measurement
  std::uint64_t ticks = 0;  ///< number of ticks to measure; 0: as many as fit into `seconds`
  int priority = 80;        ///< SCHED_FIFO priority; 0: an ordinary thread
  int cpu = -1;             ///< negative: any
  std::string plot;         ///< an SVG file; empty: none
  bool json = false;        ///< instead of text
};

/// Measures how late the loop's thread wakes and how long its ticks take. Uses inert devices: no
/// output is opened. SIGINT and SIGTERM end it early. Returns the program's exit status.
int latency_command(const LatencyOptions& options);

}  // namespace supercoil::daemon
