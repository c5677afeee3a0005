// What to do when a tick was not done in time.
#pragma once

#include <cstdint>

#include "supercoil/hal/clock.hpp"

namespace supercoil {

struct NextTick {
  hal::Time wake;  ///< absolute; always in the future of `now`, and on the grid of periods
  std::int64_t skipped = 0;  ///< whole periods that are left out; 0 when the tick was in time
};

/// Pure: the tick that was due at `due` ended at `now`. The next one is the first on the grid that
/// lies after now: periods are skipped whole, and two ticks never run back to back to catch up,
/// which would feed the filters with steps of no length.
constexpr NextTick next_tick(hal::Time due, hal::Time now, hal::Duration period) {
  const hal::Time next = due + period;
  if (now < next) return {next, 0};
  const std::int64_t late = (now - next) / period + 1;
  return {next + late * period, late};
}

}  // namespace supercoil
