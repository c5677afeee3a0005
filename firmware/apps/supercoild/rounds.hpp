// When a thread that goes round and round begins its next round.
#pragma once

#include <algorithm>

#include "supercoil/hal/clock.hpp"

namespace supercoil::daemon {

/// On a grid, whatever a round's work takes: rounds that drift against the loop's ticks would see
/// some ticks twice and others never.
class Rounds {
 public:
  explicit Rounds(hal::Time start) : next_(start) {}

  /// How long to wait from now on; asked again before the wait is over, for what is left of it.
  hal::Duration wait(hal::Time now) {
    if (next_ <= now) next_ = std::max(next_ + usual, now + min_pause);
    return next_ - now;
  }

 private:
  static constexpr std::chrono::milliseconds usual{5};
  /// Left to others when a round's work takes longer than a round.
  static constexpr std::chrono::milliseconds min_pause{1};

  hal::Time next_;
};

}  // namespace supercoil::daemon
