// Time on a board.
#pragma once

#include <chrono>

namespace supercoil::hal {

/// Time since an arbitrary start; never goes back, never jumps (CLOCK_MONOTONIC).
using Time = std::chrono::nanoseconds;
using Duration = std::chrono::nanoseconds;

/// In seconds.
constexpr double seconds(Duration duration) {
  return 1e-9 * static_cast<double>(duration.count());
}
/// For finite seconds within ±292 years; truncated to whole nanoseconds.
constexpr Duration duration_from(double seconds_) {
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds_));
}

/// Owned by the executive; used only by its thread.
class Clock {
 public:
  Clock() = default;
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;
  virtual ~Clock() = default;

  /// Costs 20 ns or less; never blocks.
  virtual Time now() const = 0;
  /// Blocks until the absolute time `wake`; returns the time at which it really woke. A time in the
  /// past returns at once. On a simulated board nothing sleeps: the board advances to that time.
  virtual Time wait_until(Time wake) = 0;
};

}  // namespace supercoil::hal
