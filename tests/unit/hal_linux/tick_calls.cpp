// The calls of the loop in a tick neither allocate, lock nor throw, even when devices fail.
#include <cstdio>
#include <memory>
#include <string>

#include <fcntl.h>
#include <unistd.h>

#include "supercoil/hal_linux/buffered_adc.hpp"
#include "supercoil/hal_linux/buffered_pwm.hpp"
#include "supercoil/hal_linux/dev_watchdog.hpp"
#include "supercoil/hal_linux/iio_adc.hpp"
#include "supercoil/hal_linux/iio_scan.hpp"
#include "supercoil/hal_linux/monotonic_clock.hpp"
#include "supercoil/hal_linux/sysfs_pwm.hpp"

#include "support/watched_calls.hpp"
#include "unit/hal_linux/support/temporary_folder.hpp"

using namespace supercoil;
using namespace supercoil::hal_linux;
using namespace supercoil::test;

namespace {

constexpr int ticks = 1000;

/// Counts and prints the calls that were not allowed.
template <class Work>
int judged(const char* what, Work work) {
  const WatchedCalls calls = counted([&] {
    for (int i = 0; i < ticks; ++i)
      work(i);
  });
  const long wrong = calls.heap + calls.news + calls.locks + calls.throws;
  const hal::Time start = MonotonicClock::time();
  for (int i = 0; i < ticks; ++i)
    work(i);
  const auto each = (MonotonicClock::time() - start) / ticks;
  std::printf("%-28s %ld allocations, locks and exceptions; %ld ns on files in memory\n", what,
              wrong, static_cast<long>(each.count()));
  return wrong == 0 ? 0 : 1;
}

Attribute attribute(const TemporaryFolder& folder, const char* name, const char* content) {
  folder.write(name, content);
  return *Attribute::open(folder / name, Attribute::Use::both);
}

PwmFiles pwm_files(const TemporaryFolder& folder) {
  return {attribute(folder, "period", "100000\n"), attribute(folder, "duty_cycle", "0\n"),
          attribute(folder, "enable", "1\n"), attribute(folder, "polarity", "normal\n")};
}

/// A scan of two inputs and the time; the device returns endless zeros.
ReadyScan ready_scan(const TemporaryFolder& folder) {
  const ScanType counts = *parse_scan_type("be:u12/16>>2");
  const ScanType time = *parse_scan_type("le:s64/64>>0");
  return {*open_file("/dev/zero", O_RDONLY),
          attribute(folder, "buffer_enable", "1"),
          {{0, counts, 0}, {1, counts, 2}},
          {2, time, 8},
          16};
}

}  // namespace

int main() {
  const TemporaryFolder folder;
  int wrong = prove_the_counters();

  MonotonicClock clock;
  wrong += judged("clock, of a time past",
                  [&](int) { static_cast<void>(clock.wait_until(clock.now())); });

  SysfsPwm pwm(pwm_files(folder), 100'000, 4095);
  wrong += judged("PWM: set", [&](int i) { static_cast<void>(pwm.set(i)); });
  wrong += judged("PWM: read back", [&](int) { static_cast<void>(pwm.read_back()); });

  IioAdc adc(attribute(folder, "raw", "1234\n"));
  wrong += judged("converter", [&](int) { static_cast<void>(adc.latest()); });
  IioAdc broken(attribute(folder, "broken", "no number\n"));
  wrong += judged("converter without a value", [&](int) { static_cast<void>(broken.latest()); });

  IioScan scan(ready_scan(folder), 64);
  wrong += judged("scan of 64", [&](int i) {
    static_cast<void>(scan.input(static_cast<std::size_t>(i % 2)).latest());
  });

  BufferedAdc buffered_adc(std::make_unique<IioAdc>(attribute(folder, "raw", "1234\n")));
  wrong +=
      judged("buffered converter: latest", [&](int) { static_cast<void>(buffered_adc.latest()); });
  wrong += judged("buffered converter: serve", [&](int) { buffered_adc.serve(); });
  BufferedPwm buffered_pwm(std::make_unique<SysfsPwm>(pwm_files(folder), 100'000, 4095));
  wrong += judged("buffered PWM: set", [&](int i) {
    static_cast<void>(buffered_pwm.set(i));
    static_cast<void>(buffered_pwm.read_back());
  });
  wrong += judged("buffered PWM: serve", [&](int i) {
    static_cast<void>(buffered_pwm.set(i));
    buffered_pwm.serve();
  });

  DevWatchdog watchdog(*open_file("/dev/null", O_WRONLY), 5, true);
  wrong += judged("watchdog", [&](int) { static_cast<void>(watchdog.feed()); });

  std::printf(wrong == 0 ? "no call of a tick allocates\n" : "FAILED\n");
  return wrong == 0 ? 0 : 1;
}
