// The loop's measured latency, for people and for programs.
#pragma once

#include <string>
#include <vector>

#include "supercoil/hal_linux/realtime.hpp"

#include "apps/supercoild/latency/meter.hpp"
#include "plot/figure.hpp"

namespace supercoil::daemon {

/// The conditions of the measurement.
struct LatencyConditions {
  double rate_Hz = 1000.0;
  std::size_t channels = 1;
  int priority = 0;  ///< SCHED_FIFO priority; 0: an ordinary thread
  std::vector<hal_linux::SetupStep> steps;
};

/// Two histograms as text, each with its smallest, mean, percentiles and largest.
std::string latency_text(const Latency& latency, const LatencyConditions& conditions);

/// An object; docs/running.md lists its fields. Times are in µs; a histogram is a list of
/// [beginning of the bin, count], without empty bins.
std::string latency_json(const Latency& latency, const LatencyConditions& conditions);

/// Two panels: the outlines of the histograms.
Figure latency_figure(const Latency& latency, const LatencyConditions& conditions);

}  // namespace supercoil::daemon
