// Frames as text, one per line, as candump -L writes it: "(1436509052.249713) can0 2C1#0011AA".
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "supercoil/hal/can_bus.hpp"
#include "supercoil/hal/error.hpp"

namespace supercoil::can_client {

/// Start time of a simulated run in its can.log: 2001-09-09 01:46:40 UTC, so that the seconds after
/// the first digit are the scenario's. Some readers (log2asc) take 0 as no time at all.
inline constexpr hal::Time simulation_epoch = std::chrono::seconds(1'000'000'000);
/// Converts a time in a simulated run's log to time since the run's start; returns any other time
/// unchanged. Logs from before the epoch was introduced start at 0.
hal::Time time_of_run(hal::Time in_log);

/// at: in the time base of the log; kept to the microsecond. Ends with a newline.
std::string candump_line(const hal::CanFrame& frame, hal::Time at, std::string_view interface);

/// One line of a log.
struct LogLine {
  hal::CanFrame frame;  ///< received: the line's time
  bool is_standard =
      true;  ///< false: an extended, remote, error or FD frame, which supercoil never sends
};
/// The error says what is wrong with the line. A direction mark after the frame, as newer candumps
/// write it, is ignored.
Result<LogLine> parse_candump_line(std::string_view line);

}  // namespace supercoil::can_client
