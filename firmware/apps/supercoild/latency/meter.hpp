// Measures the loop through the clock that it waits on.
#pragma once

#include <atomic>
#include <cstdint>

#include "supercoil/hal_linux/monotonic_clock.hpp"

#include "apps/supercoild/latency/histogram.hpp"
#include "loop/loop.hpp"

namespace supercoil::daemon {

/// The result of a measurement.
struct Latency {
  /// Bins of 1 µs, like cyclictest's, up to 100 ms.
  Histogram late{std::chrono::microseconds(1), 100'000};
  /// Bins of 0.1 µs, up to 10 ms.
  Histogram tick{std::chrono::nanoseconds(100), 100'000};
  std::int64_t overruns = 0;  ///< periods that were left out
};

/// The clock on which the executive waits for its ticks. Before each wait it records how late the
/// previous tick was and how long it took, as the loop itself measured them. So the loop's thread
/// is the real one, and nothing is added between a wake-up and the end of its tick.
class LatencyMeter final : public hal::Clock {
 public:
  /// Skips the first `settling` ticks, because the thread gets its priority shortly after it
  /// starts; then counts this many `ticks`. The loop outlives it.
  LatencyMeter(const Loop& loop, std::uint64_t settling, std::uint64_t ticks)
      : loop_(&loop), settling_(settling), ticks_(ticks) {}

  hal::Time now() const override { return clock_.now(); }
  hal::Time wait_until(hal::Time wake) override {
    note();
    return clock_.wait_until(wake);
  }

  /// May be called from any thread.
  std::uint64_t measured() const { return measured_.load(std::memory_order_relaxed); }
  bool done() const { return measured() >= ticks_; }
  hal::Duration latest() const { return hal::Duration(latest_ns_.load(std::memory_order_relaxed)); }
  /// Valid once the loop has stopped.
  const Latency& result() const { return result_; }

 private:
  void note() {
    if (waits_ <= settling_) {
      overruns_before_ = loop_->overruns();
    } else if (!done()) {
      const TickTime& tick = loop_->last_tick();
      result_.late.add(tick.late);
      result_.tick.add(tick.execution);
      result_.overruns = loop_->overruns() - overruns_before_;
      latest_ns_.store(result_.late.max().count(), std::memory_order_relaxed);
      measured_.store(result_.late.count(), std::memory_order_relaxed);
    }
    ++waits_;
  }

  const Loop* loop_;
  std::uint64_t settling_;
  std::uint64_t ticks_;
  hal_linux::MonotonicClock clock_;
  std::uint64_t waits_ = 0;
  std::int64_t overruns_before_ = 0;
  Latency result_;
  std::atomic<std::uint64_t> measured_{0};
  std::atomic<std::int64_t> latest_ns_{0};
};

}  // namespace supercoil::daemon
