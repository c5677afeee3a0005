// Runs ticks at their absolute times.
#pragma once

#include "loop/loop.hpp"
#include "loop/overrun_policy.hpp"

namespace supercoil {

/// Waits for each tick's time and runs it. On the board its thread does nothing else; in a
/// simulation the runner calls it between its own work.
class Executive {
 public:
  Executive(Loop& loop, hal::Clock& clock, double rate_Hz)
      : loop_(&loop),
        clock_(&clock),
        period_(hal::duration_from(1.0 / rate_Hz)),
        next_{clock.now() + period_, 0} {}

  void run_tick() {
    const hal::Time woke = clock_->wait_until(next_.wake);
    loop_->tick(next_.wake, woke, next_.skipped);
    next_ = next_tick(next_.wake, clock_->now(), period_);
  }
  hal::Time next_wake() const { return next_.wake; }

 private:
  Loop* loop_;
  hal::Clock* clock_;
  hal::Duration period_;
  NextTick next_;
};

}  // namespace supercoil
