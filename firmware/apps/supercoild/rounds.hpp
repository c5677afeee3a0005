// Schedules the rounds of a thread that works periodically.
#pragma once

#include <algorithm>

#include "supercoil/hal/clock.hpp"

namespace supercoil::daemon {

/// Rounds start on a fixed grid, however long a round's work takes. Rounds that drifted against the
/// loop's ticks would see some ticks twice and others never.
class Rounds {
 public:
  explicit Rounds(hal::Time start) : next_(start) {}

  /// How long to wait from `now`. When the wait ends early, call it again for the remaining time.
  hal::Duration wait(hal::Time now) {
    if (next_ <= now) next_ = std::max(next_ + usual, now + min_pause);
    return next_ - now;
  }

 private:
  static constexpr std::chrono::milliseconds usual{5};
  /// Left to other threads when a round's work takes longer than a round.
  static constexpr std::chrono::milliseconds min_pause{1};

  hal::Time next_;
};

}  // namespace supercoil::daemon
