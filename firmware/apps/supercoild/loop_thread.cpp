#include "apps/supercoild/loop_thread.hpp"

namespace supercoil::daemon {

Result<std::unique_ptr<LoopThread>> LoopThread::start(Loop& loop, hal::Clock& clock, double rate_Hz,
                                                      const hal_linux::ThreadSettings& settings) {
  std::unique_ptr<LoopThread> made(new LoopThread(loop, clock, rate_Hz));
  auto thread = hal_linux::Thread::start(settings, [made = made.get()] { made->run(); });
  if (!thread) return tl::unexpected(thread.error());
  made->thread_ = std::make_unique<hal_linux::Thread>(std::move(*thread));
  return made;
}

void LoopThread::run() {
  while (!ending_.load(std::memory_order_relaxed))
    executive_.run_tick();
}

}  // namespace supercoil::daemon
