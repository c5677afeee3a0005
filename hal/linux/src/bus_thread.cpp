#include "supercoil/hal_linux/bus_thread.hpp"

#include <utility>

#include "supercoil/hal_linux/monotonic_clock.hpp"

namespace supercoil::hal_linux {

Result<std::unique_ptr<BusThread>> BusThread::start(const ThreadSettings& settings,
                                                    hal::Duration period,
                                                    std::vector<BusDevice*> devices) {
  if (period <= hal::Duration::zero()) return failure("a bus's period must be above 0");
  std::unique_ptr<BusThread> bus(new BusThread(period, std::move(devices)));
  auto thread = Thread::start(settings, [bus = bus.get()] { bus->run(); });
  if (!thread) return tl::unexpected(thread.error());
  bus->thread_ = std::make_unique<Thread>(std::move(*thread));
  return bus;
}

BusThread::~BusThread() {
  ending_.store(true, std::memory_order_relaxed);
  thread_.reset();
}

void BusThread::run() {
  MonotonicClock clock;
  hal::Time wake = clock.now();
  while (!ending_.load(std::memory_order_relaxed)) {
    serve_all(clock.wait_until(wake));
    const auto periods = (clock.now() - wake) / period_ + 1;
    health_.skipped.fetch_add(static_cast<std::uint64_t>(periods - 1), std::memory_order_relaxed);
    wake += periods * period_;
  }
}

void BusThread::serve_all(hal::Time started) {
  for (BusDevice* device : devices_)
    device->serve();
  const std::int64_t took_ns = (MonotonicClock::time() - started).count();
  if (took_ns > health_.max_round_ns.load(std::memory_order_relaxed)) {
    health_.max_round_ns.store(took_ns, std::memory_order_relaxed);
  }
  health_.rounds.fetch_add(1, std::memory_order_release);
}

}  // namespace supercoil::hal_linux
