// Counts what the recorder allocates while it only listens: nothing is allowed to.
//
// A program of its own, because it replaces malloc, in which everything that allocates ends.
#include <cstdio>
#include <cstdlib>

#include "recorder/flight_recorder.hpp"
#include "storage/posix_files.hpp"
#include "unit/firmware/recorder/support/rows.hpp"

namespace {
long calls = 0;  // this program has one thread
}

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);

void* malloc(std::size_t size) {
  ++calls;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++calls;
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  ++calls;
  return __libc_realloc(old, size);
}
}

int main() {
  using namespace supercoil;
  storage::PosixFiles files;
  const long before = calls;
  recorder::FlightRecorder recorder("/none/there", 2, test::rate_Hz, files);
  if (calls == before) {
    std::puts("FAILED: the counter does not see what the constructor allocates");
    return 1;
  }
  const long constructed = calls;
  constexpr std::int64_t ticks = 100'000;  // the memory begins anew some sixty times
  for (std::int64_t tick = 0; tick < ticks; ++tick) {
    // The last 50 ticks have a fault whose second has not passed.
    const Fault fault = tick >= ticks - 50 ? Fault::over_travel : Fault::none;
    recorder.add(test::row(tick * test::tick_ns, 0, fault));
    recorder.add(test::row(tick * test::tick_ns, 1));
    recorder.poll(hal::Time(tick * test::tick_ns));
  }
  const long listened = calls - constructed;
  std::printf("%ld allocations in %ld ticks\n", listened, static_cast<long>(ticks));
  recorder.finish();
  if (calls - constructed == listened) {
    std::puts("FAILED: the counter does not see what writing allocates");
    return 1;
  }
  return listened == 0 ? 0 : 1;
}
