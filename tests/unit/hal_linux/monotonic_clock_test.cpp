#include "supercoil/hal_linux/monotonic_clock.hpp"

#include <cerrno>
#include <chrono>

#include <CppUTest/TestHarness.h>

#include "unit/hal_linux/support/system_calls.hpp"

using namespace supercoil;
using namespace supercoil::test;
using namespace std::chrono_literals;

TEST_GROUP(MonotonicClock) {
  hal_linux::MonotonicClock clock;
  void teardown() override {
    reset_calls();
  }
};

TEST(MonotonicClock, NeverGoesBack) {
  hal::Time last = clock.now();
  for (int i = 0; i < 1000; ++i) {
    const hal::Time now = clock.now();
    CHECK(now >= last);
    last = now;
  }
}

TEST(MonotonicClock, WakesAtTheTimeOrLater) {
  const hal::Time wake = clock.now() + 3ms;
  const hal::Time woke = clock.wait_until(wake);
  CHECK(woke >= wake);
  CHECK(woke <= clock.now());
}

TEST(MonotonicClock, ReturnsAtOnceFromATimeThatIsPast) {
  next(Call::clock_nanosleep, "", [] { return 0; });  // not even called
  for (const hal::Time wake : {hal::Time(0), hal::Time(-1), hal::Time(-5s), clock.now() - 1ns}) {
    const hal::Time woke = clock.wait_until(wake);
    CHECK(woke > wake && woke <= clock.now());
  }
  LONGS_EQUAL(1, waiting());
}

TEST(MonotonicClock, KeepsSleepingThroughSignals) {
  fail_next(Call::clock_nanosleep, "", EINTR, 5);
  const hal::Time wake = clock.now() + 2ms;
  CHECK(clock.wait_until(wake) >= wake);
  LONGS_EQUAL(0, waiting());
}

TEST(MonotonicClock, DoesNotSpinWhereTheKernelRefusesToSleep) {
  fail_next(Call::clock_nanosleep, "", EINVAL, 2);
  clock.wait_until(clock.now() + 2ms);
  LONGS_EQUAL(1, waiting());
}
