#include "loop/overrun_policy.hpp"

#include <CppUTest/TestHarness.h>
#include <rapidcheck.h>

using namespace supercoil;
using namespace std::chrono_literals;

TEST_GROUP(OverrunPolicy){};

TEST(OverrunPolicy, InTimeMeansTheNextPeriod) {
  const NextTick next = next_tick(10ms, 10500us, 1ms);
  CHECK(next.wake == 11ms);
  LONGS_EQUAL(0, next.skipped);
}

TEST(OverrunPolicy, EndingAtTheNextTickMissesIt) {
  const NextTick next = next_tick(10ms, 11ms, 1ms);
  CHECK(next.wake == 12ms);
  LONGS_EQUAL(1, next.skipped);
}

TEST(OverrunPolicy, SkipsTicksAfterALongStallAndDoesNotCatchUp) {
  const NextTick next = next_tick(10ms, 10ms + 5s + 300us, 1ms);
  CHECK(next.wake == 5011ms);
  LONGS_EQUAL(5000, next.skipped);
}

TEST(OverrunPolicy, AlwaysWakesInTheFutureOnTheGridWithinAPeriod) {
  CHECK(rc::check("next tick", [] {
    const hal::Time due{*rc::gen::inRange<long>(0, 1000000000000)};
    const hal::Duration period{*rc::gen::inRange<long>(100000, 10000000)};
    const hal::Time now = due + hal::Duration{*rc::gen::inRange<long>(0, 1000000000)};
    const NextTick next = next_tick(due, now, period);
    RC_ASSERT(next.wake > now);
    RC_ASSERT(next.wake - now <= period);
    RC_ASSERT(next.wake == due + (next.skipped + 1) * period);
    RC_ASSERT(next.skipped >= 0);
  }));
}
