// Logs buses that are too slow for the loop.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "supercoil/hal/clock.hpp"

#include "linux_board/linux_board.hpp"

namespace supercoil::daemon {

/// When a round takes longer than a tick, whole rounds are left out: duties act later, and readings
/// are older. Reported when it first happens, and then at most once a minute while it lasts.
class BusWatch {
 public:
  /// Lines for the log. buses: always the same ones, in the same order.
  std::vector<std::string> new_warnings(const std::vector<linux_board::BusReport>& buses,
                                        hal::Time now) {
    std::vector<std::string> lines;
    reported_.resize(buses.size());
    for (std::size_t i = 0; i < buses.size(); ++i) {
      const linux_board::BusReport& bus = buses[i];
      Reported& reported = reported_[i];
      const bool waits = reported.at && now - *reported.at < pause;
      if (bus.left_out == reported.left_out || waits) continue;
      reported = {bus.left_out, now};
      std::array<char, 40> max_text{};
      std::snprintf(max_text.data(), max_text.size(), "%.1f ms", 1e3 * bus.max_s);
      lines.push_back("bus " + bus.name +
                      " is too slow for the loop: " + std::to_string(bus.left_out) +
                      " rounds left out so far, the longest took " + max_text.data());
    }
    return lines;
  }

 private:
  static constexpr hal::Duration pause = std::chrono::minutes(1);

  struct Reported {
    std::uint64_t left_out = 0;
    std::optional<hal::Time> at;
  };
  std::vector<Reported> reported_;
};

}  // namespace supercoil::daemon
