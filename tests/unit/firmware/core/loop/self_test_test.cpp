#include "loop/self_test.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>

#include "unit/firmware/core/support/tick.hpp"

using supercoil::SelfTest;
using supercoil::test::tick_s;

namespace {

constexpr double idle_A = 0.007;

/// Runs the self-test on a board whose current depends on the lines.
template <class Current>
SelfTest::Outcome outcome(Current current) {
  SelfTest test({0.02}, tick_s);
  for (int i = 0; i < 10000 && !test.passed() && !test.failed(); ++i) {
    test.step(true, current(test.lines()), idle_A);
  }
  return test.outcome();
}

}  // namespace

TEST_GROUP(SelfTest){};

TEST(SelfTest, PassesWhenNothingEverFlows) {
  CHECK(outcome([](SelfTest::Lines) { return 0.001; }) == SelfTest::Outcome::passed);
}

TEST(SelfTest, FindsASupplySwitchThatIsStuckClosed) {
  const auto current = [](SelfTest::Lines l) { return l.pulse && l.enable ? 0.024 : 0.0; };
  CHECK(outcome(current) == SelfTest::Outcome::pump_does_not_open);
}

TEST(SelfTest, FindsAnEnableLineThatDoesNotCut) {
  const auto current = [](SelfTest::Lines l) { return l.pulse && l.heartbeat ? 0.024 : 0.0; };
  CHECK(outcome(current) == SelfTest::Outcome::enable_does_not_cut);
}

/// Each pulse is judged by itself: a low current in the first cannot offset the second.
TEST(SelfTest, DetectsOneAndAHalfTimesTheIdleCurrentInEitherPulse) {
  const auto past_pump = [](SelfTest::Lines l) { return l.pulse && l.enable ? 1.5 * idle_A : 0.0; };
  CHECK(outcome(past_pump) == SelfTest::Outcome::pump_does_not_open);
  const auto past_enable = [](SelfTest::Lines l) {
    return l.pulse && l.heartbeat ? 1.5 * idle_A : 0.0;
  };
  CHECK(outcome(past_enable) == SelfTest::Outcome::enable_does_not_cut);
}

/// Nor can a low current from before an interruption.
TEST(SelfTest, RestartsItsMeansAfterAnInterruption) {
  SelfTest test({0.02}, tick_s);
  int pulse_ticks = 0;
  while (pulse_ticks < 28) {
    pulse_ticks += test.lines().pulse ? 1 : 0;
    test.step(true, 0.0, idle_A);
  }
  test.step(false, 0.0, idle_A);
  while (!test.passed() && !test.failed()) {
    const auto lines = test.lines();
    test.step(true, lines.pulse && lines.enable ? 1.5 * idle_A : 0.0, idle_A);
  }
  CHECK(test.outcome() == SelfTest::Outcome::pump_does_not_open);
}

TEST(SelfTest, NeverClosesBothSwitchesAtOnce) {
  SelfTest test({0.02}, tick_s);
  int pulses = 0;
  while (!test.passed()) {
    const auto lines = test.lines();
    CHECK_FALSE(lines.pulse && lines.enable && lines.heartbeat);
    pulses += lines.pulse ? 1 : 0;
    test.step(true, 0.0, idle_A);
  }
  LONGS_EQUAL(60, pulses);
}

TEST(SelfTest, WaitsForAnEarlierRunsChargePumpToDecay) {
  SelfTest test({0.02}, tick_s);
  for (int i = 0; i < 20; ++i) {
    CHECK_FALSE(test.lines().pulse);
    test.step(true, 0.0, idle_A);
  }
}

TEST(SelfTest, IsNotFailedByASingleNoisyReading) {
  int tick = 0;
  const auto current = [&](SelfTest::Lines l) { return l.pulse && ++tick % 7 == 0 ? 0.024 : 0.0; };
  CHECK(outcome(current) == SelfTest::Outcome::passed);
}

TEST(SelfTest, DetectsAStuckOnSwitchAsSoonAsTheSupplyCloses) {
  SelfTest test({0.02}, tick_s);
  int hot_ticks = 0;
  while (!test.passed() && !test.failed()) {
    const bool hot = test.lines().heartbeat;
    hot_ticks += hot ? 1 : 0;
    test.step(true, hot ? 1.2 : 0.0, idle_A);
  }
  CHECK(test.outcome() == SelfTest::Outcome::enable_does_not_cut);
  CHECK_COMPARE(hot_ticks, <=, 10);
}

TEST(SelfTest, WaitsColdWhileNotAllowedAndRestarts) {
  SelfTest test({0.02}, tick_s);
  for (int i = 0; i < 90; ++i)
    test.step(true, 0.0, idle_A);
  CHECK(test.lines().pulse);
  test.step(false, 0.0, idle_A);
  CHECK_FALSE(test.lines().pulse || test.lines().enable || test.lines().heartbeat);
  int ticks = 0;
  for (; !test.passed(); ++ticks)
    test.step(true, 0.0, idle_A);
  DOUBLES_EQUAL(test.duration_s(), ticks * tick_s, 2e-3);
}

TEST(SelfTest, FailsOnACurrentOfNaN) {
  const auto current = [](SelfTest::Lines l) { return l.pulse ? NAN : 0.0; };
  CHECK(outcome(current) == SelfTest::Outcome::pump_does_not_open);
}

TEST(SelfTest, KeepsItsOutcome) {
  for (const bool well : {true, false}) {
    SelfTest test({0.02}, tick_s);
    const auto step = [&](double current_A) { test.step(true, current_A, idle_A); };
    while (!test.passed() && !test.failed())
      step(well ? 0.0 : 1.2);
    const SelfTest::Outcome decided = test.outcome();
    CHECK((decided == SelfTest::Outcome::passed) == well);
    for (int i = 0; i < 1000; ++i)
      step(well ? 1.2 : 0.0);
    CHECK(test.outcome() == decided);
  }
}

TEST(SelfTest, FailsWhereAPulseIsTooShortToBeMeasured) {
  SelfTest test({.pump_decay_s = 0.02, .pulse_s = tick_s}, tick_s);
  for (int i = 0; i < 1000; ++i)
    test.step(true, 0.0, idle_A);
  CHECK(test.outcome() == SelfTest::Outcome::pump_does_not_open);
}

TEST(SelfTest, CountsTimeFromTheFirstTick) {
  SelfTest test({0.02}, tick_s);
  int ticks = 0;
  for (; !test.passed(); ++ticks)
    test.step(true, 0.0, idle_A);
  DOUBLES_EQUAL(0.02 + 3.0 * 0.05 + 2.0 * 0.03, test.duration_s(), 1e-12);
  DOUBLES_EQUAL(test.duration_s(), ticks * tick_s, 2e-3);
}

TEST(SelfTest, ThatHasFailedLeavesEveryLineLow) {
  for (const bool pump_is_stuck : {true, false}) {
    SelfTest test({0.02}, tick_s);
    while (!test.failed()) {
      const SelfTest::Lines lines = test.lines();
      const bool flows = lines.pulse && (pump_is_stuck ? lines.enable : lines.heartbeat);
      test.step(true, flows ? 1.2 : 0.0, idle_A);
    }
    const SelfTest::Lines lines = test.lines();
    CHECK_FALSE(lines.heartbeat || lines.enable || lines.pulse);
  }
}

/// Only the mean over the second half of a pulse counts, wherever the noise is within it.
TEST(SelfTest, IsNotDecidedByTheLastReadingOfAPulse) {
  for (const bool only_last : {true, false}) {
    SelfTest test({0.02}, tick_s);
    int in_pulse = 0;
    while (!test.passed() && !test.failed()) {
      in_pulse = test.lines().pulse ? in_pulse + 1 : 0;
      const bool last = in_pulse == 30;
      test.step(true, in_pulse > 0 && last == only_last ? 0.024 : 0.0, idle_A);
    }
    CHECK_EQUAL(only_last, test.passed());
  }
}
