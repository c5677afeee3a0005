// Measures how long a device's calls take.
#pragma once

#include <functional>
#include <string>

#include "supercoil/hal/board_check.hpp"
#include "supercoil/hal/clock.hpp"

namespace supercoil::doctor {

/// For a device that is called in the tick (docs/configuration.md).
inline constexpr hal::Duration max_direct_call = std::chrono::microseconds(20);

struct CallTime {
  hal::Duration mean{};
  hal::Duration p99{};  ///< 99 of 100 calls take no longer; this one is judged
  hal::Duration worst{};
  int calls = 0;
  int interrupted = 0;     ///< further calls, in which another thread took the processor
  bool real_time = false;  ///< measured at the loop's priority
};

/// Times repeated calls from a thread with this SCHED_FIFO priority, or from an ordinary one if
/// that is not permitted. Waiting within a call counts as the device's time. A call during which
/// the processor was taken away does not count, and is repeated. The kernel's own interrupts cannot
/// be told from the device: they hit calls at random, so the slowest of a hundred is ignored.
CallTime time_calls(const std::function<void()>& call, int priority);

/// "3.1 us on average, 99 % within 3.9 us, 8.2 us at most, of 200 calls".
std::string time_text(const CallTime& time);

/// The finding on a direct device of which only the call time is left to judge. found: the other
/// results; remedy: for a slow device.
hal::Finding assess(const std::string& what, const std::string& found, const CallTime& time,
                    const std::string& remedy);

}  // namespace supercoil::doctor
