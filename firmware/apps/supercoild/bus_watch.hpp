// Buses that are too slow for the loop, told in the log.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "supercoil/hal/clock.hpp"

#include "linux_board/linux_board.hpp"

namespace supercoil::daemon {

/// A round that takes longer than a tick leaves whole rounds out: duties act later, and readings
/// are older. Told when it first happens, and then at most once a minute while it goes on.
class BusWatch {
 public:
  /// Lines for the log; buses: always the same ones, in the same order.
  std::vector<std::string> news(const std::vector<linux_board::BusReport>& buses, hal::Time now);

 private:
  static constexpr hal::Duration pause = std::chrono::minutes(1);

  struct Told {
    std::uint64_t left_out = 0;
    std::optional<hal::Time> at;
  };
  std::vector<Told> reported_;
};

}  // namespace supercoil::daemon
