// Frames as text, a line each, as candump -L writes them: "(1436509052.249713) can0 2C1#0011AA".
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "supercoil/hal/can_bus.hpp"
#include "supercoil/hal/error.hpp"

namespace supercoil::can_client {

/// At which a simulated run begins in its can.log: 2001-09-09 01:46:40 UTC, so that the seconds
/// behind the first digit are the scenario's. 0 would be no time at all to some readers (log2asc).
inline constexpr hal::Time simulation_epoch = std::chrono::seconds(1'000'000'000);
/// Of a time in a log: since the begin of the run where it is a simulated one's, else as it is.
/// Logs of before the epoch was introduced begin at 0.
hal::Time time_of_run(hal::Time in_log);

/// at: from whenever the log's times are counted; microseconds are kept. Ends with a newline.
std::string candump_line(const hal::CanFrame& frame, hal::Time at, std::string_view interface);

/// One line of a log.
struct LogLine {
  hal::CanFrame frame;  ///< received: the line's time
  bool ours = true;  ///< false: an extended, remote, error or FD frame, which supercoil never sends
};
/// Error: what is wrong with the line. A sign of direction behind the frame, as newer candumps
/// write it, is passed over.
Result<LogLine> parse_candump_line(std::string_view line);

}  // namespace supercoil::can_client
