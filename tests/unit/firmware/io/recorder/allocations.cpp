// Counts what the recorder allocates while it only listens: it must not allocate at all.
//
// This is a separate program because it replaces malloc, which all allocations end in.
#include <cstdio>

#include "recorder/flight_recorder.hpp"
#include "storage/posix_files.hpp"
#include "support/watched_calls.hpp"
#include "unit/firmware/io/recorder/support/rows.hpp"

int main() {
  using namespace supercoil;
  const int unseen = test::prove_the_counters();
  storage::PosixFiles files;
  recorder::FlightRecorder recorder("/none/there", 2, test::rate_Hz, files);
  constexpr std::int64_t ticks = 100'000;  // the memory wraps around some sixty times
  const test::WatchedCalls listened = test::counted([&] {
    for (std::int64_t tick = 0; tick < ticks; ++tick) {
      // The last 50 ticks have a fault, with less than a second recorded after it.
      const Fault fault = tick >= ticks - 50 ? Fault::over_travel : Fault::none;
      recorder.add(test::row(tick * test::tick_ns, 0, fault));
      recorder.add(test::row(tick * test::tick_ns, 1));
      recorder.poll(hal::Time(tick * test::tick_ns));
    }
  });
  std::printf("%ld calls in %ld ticks\n", listened.all(), static_cast<long>(ticks));
  const test::WatchedCalls wrote = test::counted([&] { recorder.finish(); });
  if (wrote.all() == 0) std::puts("FAILED: writing was not reached");
  return unseen == 0 && listened.all() == 0 && wrote.all() > 0 ? 0 : 1;
}
