// The simulated board in step with the real clock, so that real threads can drive it.
#pragma once

#include "supercoil/hal_linux/monotonic_clock.hpp"

#include "simulated_board/simulated_board.hpp"

namespace supercoil::test {

/// Only the loop's thread uses it once that thread runs.
class RealTimeBoard final : public hal::Clock {
 public:
  explicit RealTimeBoard(const host_sim::SimulatedBoardSettings& settings)
      : board_(settings), begin_(clock_.now()) {}

  hal::Time now() const override { return clock_.now() - begin_; }
  hal::Time wait_until(hal::Time wake) override {
    clock_.wait_until(begin_ + wake);
    board_.advance_to(now());
    return now();
  }
  board::Devices devices() {
    board::Devices devices = board_.devices();
    devices.clock = this;
    return devices;
  }

 private:
  host_sim::SimulatedBoard board_;
  hal_linux::MonotonicClock clock_;
  hal::Time begin_;
};

}  // namespace supercoil::test
