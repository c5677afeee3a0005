#include "apps/supercoild/bus_watch.hpp"

#include <array>
#include <cstdio>

namespace supercoil::daemon {

std::vector<std::string> BusWatch::news(const std::vector<linux_board::BusReport>& buses,
                                        hal::Time now) {
  std::vector<std::string> lines;
  reported_.resize(buses.size());
  for (std::size_t i = 0; i < buses.size(); ++i) {
    const linux_board::BusReport& bus = buses[i];
    Told& told = reported_[i];
    const bool waits = told.at && now - *told.at < pause;
    if (bus.left_out == told.left_out || waits) continue;
    told = {bus.left_out, now};
    std::array<char, 40> longest{};
    std::snprintf(longest.data(), longest.size(), "%.1f ms", 1e3 * bus.max_s);
    lines.push_back("bus " + bus.name +
                    " is too slow for the loop: " + std::to_string(bus.left_out) +
                    " rounds left out so far, the longest took " + longest.data());
  }
  return lines;
}

}  // namespace supercoil::daemon
