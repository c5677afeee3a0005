// Keeps a simulation in step with the clock on the wall.
#pragma once

#include <chrono>
#include <cstdint>
#include <thread>

namespace supercoil::host_sim {

class Pace {
 public:
  explicit Pace(double step_s)
      : step_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(step_s))) {}

  /// Waits until the next tick is due. The simulation makes up for delays of up to a second that a
  /// busy machine causes; after a longer one it stays that far behind.
  void wait() {
    next_ += step_;
    const auto now = Clock::now();
    if (now - next_ > std::chrono::seconds(1)) {
      next_ = now;
      ++slips_;
    }
    std::this_thread::sleep_until(next_);
  }
  /// How often it was more than a second behind.
  std::int64_t slips() const { return slips_; }
  double elapsed_s() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::duration step_;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point next_ = begin_;
  std::int64_t slips_ = 0;
};

}  // namespace supercoil::host_sim
