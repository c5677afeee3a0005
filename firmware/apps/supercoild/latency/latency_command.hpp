// supercoild --latency
#pragma once

#include <cstdint>
#include <string>

namespace supercoil::daemon {

struct LatencyOptions {
  std::string config;       ///< empty: one channel at rate_Hz
  double rate_Hz = 1000.0;  ///< 100 to 10000
  double seconds = 10.0;    ///< how long is measured
  std::uint64_t ticks = 0;  ///< how many are measured; 0: as many as fit into `seconds`
  int priority = 80;        ///< of SCHED_FIFO; 0: an ordinary thread
  int cpu = -1;             ///< negative: any
  std::string plot;         ///< an SVG file; empty: none
  bool json = false;        ///< instead of text
};

/// Measures how late the loop's thread wakes and how long its ticks take, over devices that are
/// none: no output is opened. SIGINT and SIGTERM end it early. Returns the program's exit status.
int latency_command(const LatencyOptions& options);

}  // namespace supercoil::daemon
