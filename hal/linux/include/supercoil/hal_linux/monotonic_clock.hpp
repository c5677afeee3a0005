// The time of CLOCK_MONOTONIC.
#pragma once

#include "supercoil/hal/clock.hpp"

namespace supercoil::hal_linux {

/// Has no state: each thread may have its own.
class MonotonicClock final : public hal::Clock {
 public:
  hal::Time now() const override { return time(); }
  /// Sleeps until an absolute time, even when signals arrive.
  hal::Time wait_until(hal::Time wake) override;

  /// now() without an object.
  static hal::Time time() noexcept;
};

}  // namespace supercoil::hal_linux
