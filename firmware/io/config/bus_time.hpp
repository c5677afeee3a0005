// How long the devices of a bus keep it busy in a tick.
#pragma once

#include <string>
#include <vector>

#include "config/wiring.hpp"

namespace supercoil::config {

/// Fraction of a tick; more is refused. The rest is for retries and for a busy kernel.
inline constexpr double max_bus_load = 0.7;

/// A device on a bus, and how long the bus is busy with it in each tick.
struct BusUser {
  std::string what;  ///< e.g. "channel 1 position"
  double time_s;     ///< of one access
};

/// What all devices of a bus take of a tick.
struct BusTime {
  std::vector<BusUser> users;
  double total_s = 0.0;  ///< every device served once
};

/// Duration of one transaction of this many bytes.
double transaction_s(const BusAddress& bus, int bytes);

/// Only devices that are buffered on this bus count.
BusTime bus_time(const BoardWiring& wiring, const BusAddress& bus);

}  // namespace supercoil::config
