// Serves every device of a slow bus, beside the loop.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "supercoil/hal/clock.hpp"
#include "supercoil/hal/error.hpp"
#include "supercoil/hal_linux/bus_device.hpp"
#include "supercoil/hal_linux/thread.hpp"

namespace supercoil::hal_linux {

/// Statistics of a bus's rounds; written by its thread, read by any.
struct BusHealth {
  std::atomic<std::uint64_t> rounds{0};   ///< finished
  std::atomic<std::uint64_t> skipped{0};  ///< periods left out because a round took too long
  std::atomic<std::int64_t> max_round_ns{0};
};

/// Serves the devices once a period, one after the other, in order. A device that fails is served
/// again in the next round like all others; one that blocks delays those after it. A round that
/// takes longer than the period leaves whole periods out.
class BusThread {
 public:
  /// devices: not null; they must outlive this. Put PWM outputs first: a duty should not wait for
  /// conversions.
  static Result<std::unique_ptr<BusThread>> start(const ThreadSettings& settings,
                                                  hal::Duration period,
                                                  std::vector<BusDevice*> devices);
  BusThread(const BusThread&) = delete;
  BusThread& operator=(const BusThread&) = delete;
  /// Waits for the round under way, and for at most a period more.
  ~BusThread();

  const BusHealth& health() const { return health_; }
  /// The results of setting the thread's priority and CPU.
  const std::vector<SetupStep>& steps() const { return thread_->steps(); }

 private:
  BusThread(hal::Duration period, std::vector<BusDevice*> devices)
      : period_(period), devices_(std::move(devices)) {}

  void run();
  void serve_all(hal::Time started);

  hal::Duration period_;
  std::vector<BusDevice*> devices_;
  BusHealth health_;
  std::atomic<bool> ending_{false};
  std::unique_ptr<Thread> thread_;
};

}  // namespace supercoil::hal_linux
