// The thread of the control loop.
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "supercoil/hal/error.hpp"
#include "supercoil/hal_linux/thread.hpp"

#include "loop/executive.hpp"

namespace supercoil::daemon {

class LoopThread {
 public:
  /// Both outlive it. The thread starts at once.
  static Result<std::unique_ptr<LoopThread>> start(Loop& loop, hal::Clock& clock, double rate_Hz,
                                                   const hal_linux::ThreadSettings& settings);

  /// Stops after the current tick; the destructor waits for it.
  void stop() { ending_.store(true, std::memory_order_relaxed); }
  const std::vector<hal_linux::SetupStep>& steps() const { return thread_->steps(); }

 private:
  LoopThread(Loop& loop, hal::Clock& clock, double rate_Hz) : executive_(loop, clock, rate_Hz) {}
  void run();

  Executive executive_;
  std::atomic<bool> ending_{false};
  std::unique_ptr<hal_linux::Thread> thread_;
};

}  // namespace supercoil::daemon
