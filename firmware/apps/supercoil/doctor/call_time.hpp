// How long a device's calls take.
#pragma once

#include <functional>
#include <string>

#include "supercoil/hal/board_check.hpp"
#include "supercoil/hal/clock.hpp"

namespace supercoil::doctor {

/// Of a device that is called in the tick (docs/configuration.md).
inline constexpr hal::Duration max_direct_call = std::chrono::microseconds(20);

struct CallTime {
  hal::Duration mean{};
  hal::Duration p99{};  ///< 99 of 100 calls take no longer: what counts
  hal::Duration worst{};
  int calls = 0;
  int interrupted = 0;     ///< further ones, in which another thread took the processor
  bool real_time = false;  ///< measured at the loop's priority
};

/// Calls again and again from a thread of this priority of SCHED_FIFO, or from an ordinary one
/// where that may not be had. A call that waits is the device's; one in which the processor was
/// taken away is not, and is made again. The kernel's own interrupts cannot be told from the
/// device: they hit one call or another, and the slowest of a hundred is left out for them.
CallTime time_calls(const std::function<void()>& call, int priority);

/// "3.1 us on average, 99 % within 3.9 us, 8.2 us at most, of 200 calls".
std::string shown(const CallTime& time);

/// Of a direct device that is in order but for its calls' time. found: the rest; remedy: for a slow
/// one.
hal::Finding judged(const std::string& what, const std::string& found, const CallTime& time,
                    const std::string& remedy);

}  // namespace supercoil::doctor
