// What to do when a tick overruns.
#pragma once

#include <cstdint>

#include "supercoil/hal/clock.hpp"

namespace supercoil {

/// When to wake next.
struct NextTick {
  hal::Time wake;            ///< absolute; always after `now`, and on the grid of periods
  std::int64_t skipped = 0;  ///< whole periods that are left out; 0 when the tick was in time
};

/// Pure: the tick that was due at `due` ended at `now`; the next is the first on the grid after
/// now. Whole periods are skipped. Two ticks never run back to back to catch up, which would give
/// the filters steps of zero length.
constexpr NextTick next_tick(hal::Time due, hal::Time now, hal::Duration period) {
  const hal::Time next = due + period;
  if (now < next) return {next, 0};
  const std::int64_t late = (now - next) / period + 1;
  return {next + late * period, late};
}

}  // namespace supercoil
