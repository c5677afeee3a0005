#include <algorithm>
#include <cmath>

#include <CppUTest/TestHarness.h>

#include "supervisor/detectors/heater.hpp"
#include "unit/firmware/core/support/tick.hpp"

using namespace supercoil::detectors;
using supercoil::test::tick_s;

namespace {

/// Ticks until the detector trips, or -1.
template <class Step>
int ticks_until(Step step, int max_ticks = 100000) {
  for (int tick = 1; tick <= max_ticks; ++tick) {
    if (step(tick)) return tick;
  }
  return -1;
}

}  // namespace

TEST_GROUP(HeaterDetectors){};

TEST(HeaterDetectors, OpenLoadTripsForDutyWithoutCurrent) {
  OpenLoad detector({0.02, 0.5, 0.02}, tick_s);
  LONGS_EQUAL(20, ticks_until([&](int) { return detector.step(0.3, 0.01); }));
}

TEST(HeaterDetectors, OpenLoadIgnoresASmallDutyAndAGoodHeater) {
  OpenLoad detector({0.02, 0.5, 0.02}, tick_s);
  LONGS_EQUAL(-1, ticks_until([&](int) { return detector.step(0.01, 0.0); }, 1000));
  LONGS_EQUAL(-1, ticks_until([&](int) { return detector.step(0.3, 0.36); }, 1000));
  DOUBLES_EQUAL(0.15 / 0.36, detector.margin().used(), 1e-9);
}

TEST(HeaterDetectors, OpenLoadTripsForACurrentOfNaN) {
  OpenLoad detector({0.02, 0.5, 0.002}, tick_s);
  LONGS_EQUAL(2, ticks_until([&](int) { return detector.step(0.3, std::nan("")); }));
}

TEST(HeaterDetectors, ShortTripsAboveItsCurrent) {
  Short detector({3.0, 0.002}, tick_s);
  CHECK_FALSE(detector.step(3.0));
  CHECK_FALSE(detector.step(5.0));
  CHECK(detector.step(5.0));
}

TEST(HeaterDetectors, StuckOnTripsForCurrentWhileOff) {
  StuckOn detector({0.02, 0.05}, tick_s);
  LONGS_EQUAL(50, ticks_until([&](int) { return detector.step(true, 0.4); }));
}

TEST(HeaterDetectors, StuckOnHasNothingToJudgeWhileOn) {
  StuckOn detector({0.02, 0.05}, tick_s);
  detector.step(false, 0.4);
  CHECK_FALSE(detector.margin().judged);
  detector.step(true, 0.4);
  CHECK(detector.margin().judged);
  DOUBLES_EQUAL(20.0, detector.margin().used(), 1e-9);
}

TEST(HeaterDetectors, StuckOnAllowsTheSenseFilterToDecay) {
  StuckOn detector({0.02, 0.05}, tick_s);
  LONGS_EQUAL(
      -1, ticks_until(
              [&](int tick) { return detector.step(true, 1.2 * std::exp(-tick * tick_s / 0.01)); },
              1000));
  LONGS_EQUAL(-1, ticks_until([&](int) { return detector.step(false, 1.2); }, 1000));
}

/// At 100 Hz, a sense with a lag of 10 ms reads 6.8 mA 50 ms after 0.67 A is switched off.
TEST(HeaterDetectors, StuckOnWaitsForASlowSenseButNotForAStuckSwitch) {
  constexpr double slow_tick_s = 0.01;
  const StuckOn::Settings settings{.max_A = 0.005, .hold_s = 0.05, .filter_s = 0.01};
  const auto ticks_off = [&](double lag_ticks, double leak_A) {
    StuckOn detector(settings, slow_tick_s);
    detector.step(false, 0.67);
    return ticks_until(
        [&](int tick) {
          return detector.step(
              true, std::fmax(leak_A, 0.67 * std::exp(-std::fmax(0.0, 1.0 + tick - lag_ticks))));
        },
        100);
  };
  LONGS_EQUAL(-1, ticks_off(0.0, 0.0));
  LONGS_EQUAL(-1, ticks_off(1.0, 0.0));
  // Stuck, and leaking as much as the sense may still read at that time.
  LONGS_EQUAL(5, ticks_off(0.0, 0.67));
  LONGS_EQUAL(5, ticks_off(0.0, 0.05));
  LONGS_EQUAL(8, ticks_off(0.0, 0.01));
}

/// The readings while the heater was on may be anything.
TEST(HeaterDetectors, StuckOnUsesOnlyFiniteCurrents) {
  for (const double unknown : {std::nan(""), static_cast<double>(INFINITY)}) {
    StuckOn detector({.max_A = 0.02, .hold_s = 0.05, .filter_s = 0.01}, tick_s);
    detector.step(false, unknown);
    LONGS_EQUAL(50, ticks_until([&](int) { return detector.step(true, unknown); }));
  }
}

TEST(HeaterDetectors, NotRespondingTripsWhenTheMuscleDoesNotMoveAsExpected) {
  NotResponding detector({20.0, 0.3, 0.001}, tick_s);
  const int ticks = ticks_until([&](int tick) {
    const double t = tick * tick_s;
    const double expected = 0.002 * t / 20.0;
    return detector.step(0.0003 * t / 20.0,
                         NotResponding::possible({expected, expected, expected}));
  });
  LONGS_EQUAL(20000, ticks);
  DOUBLES_EQUAL(0.0003, detector.margin().measured, 1e-6);
  // Motion that was expected in the last second may still come.
  DOUBLES_EQUAL(0.3 * 0.95 * 0.002, detector.margin().limit, 1e-6);
}

TEST(HeaterDetectors, NotRespondingDoesNotTripForAMovingMuscle) {
  NotResponding detector({20.0, 0.3, 0.001}, tick_s);
  LONGS_EQUAL(-1, ticks_until([&](int tick) {
    const double expected = 0.011 + 0.009 * std::sin(0.25 * tick * tick_s);
    return detector.step(0.8 * expected, NotResponding::possible({expected, expected, expected}));
  }));
}

TEST(HeaterDetectors, NotRespondingDoesNotJudgeRest) {
  NotResponding detector({20.0, 0.3, 0.001}, tick_s);
  LONGS_EQUAL(-1, ticks_until([&](int) {
    return detector.step(0.01, NotResponding::possible({0.011, 0.011, 0.011}));
  }));
}

TEST(HeaterDetectors, NotRespondingIgnoresMotionThatAMuscleMayHaveEnded) {
  // It is held: the slowest possible muscle still creeps, a faster one has arrived.
  for (const std::size_t slow : {0U, 1U, 2U}) {
    NotResponding detector({20.0, 0.3, 0.001}, tick_s);
    NotResponding::Expected expected{0.011, 0.011, 0.011};
    LONGS_EQUAL(-1, ticks_until([&](int tick) {
      expected = {0.011, 0.011, 0.011};
      expected[slow] += 0.005 * tick * tick_s / 20.0;
      return detector.step(0.011, NotResponding::possible(expected));
    }));
  }
}

TEST(HeaterDetectors, NotRespondingDoesNotJudgeWhenModelsDisagreeOnTheDirection) {
  // Derated: a slow muscle still warms while a fast one already cools.
  NotResponding detector({20.0, 0.3, 0.001}, tick_s);
  LONGS_EQUAL(-1, ticks_until([&](int tick) {
    const double moved = 0.004 * tick * tick_s / 20.0;
    return detector.step(0.011,
                         NotResponding::possible({0.011 + moved, 0.011 + moved, 0.011 - moved}));
  }));
}

TEST(HeaterDetectors, NotRespondingAllowsTimeForMotionRequestedAtTheWindowsEnd) {
  NotResponding detector({20.0, 0.3, 0.001}, tick_s);
  LONGS_EQUAL(
      -1,
      ticks_until(
          [&](int tick) {
            const double expected = tick < 19'500 ? 0.011 : 0.008;
            return detector.step(0.011, NotResponding::possible({expected, expected, expected}));
          },
          20'000));
}

TEST(HeaterDetectors, WrongDutyTripsWhenItPersists) {
  WrongDuty detector(0.003, tick_s);
  CHECK_FALSE(detector.step(100, 90));
  CHECK_FALSE(detector.step(100, 100));
  LONGS_EQUAL(3, ticks_until([&](int) { return detector.step(100, 90); }));
  CHECK_FALSE(detector.step(100, -1));
}

TEST(HeaterDetectors, NotRespondingJudgesEachWindowSeparately) {
  // The muscle moved as expected in the first window, but not in the second.
  NotResponding detector({20.0, 0.3, 0.001}, tick_s);
  const int ticks = ticks_until([&](int tick) {
    const double t = tick * tick_s;
    const double expected = 0.002 * t / 20.0;
    return detector.step(std::min(0.002, expected),
                         NotResponding::possible({expected, expected, expected}));
  });
  LONGS_EQUAL(40000, ticks);
  DOUBLES_EQUAL(0.0, detector.margin().measured, 1e-6);
}

TEST(HeaterDetectors, NotRespondingRestartsAfterAResponseToTheSameTarget) {
  NotResponding detector({20.0, 0.3, 0.001}, tick_s);
  const auto step = [&](double expected_m) {
    return detector.step(0.011, NotResponding::possible({expected_m, expected_m, expected_m}));
  };
  // In a draught more power held it still; it answered, and nothing more is expected after that.
  const auto in_draught = [&](int tick) {
    if (tick == 10000) detector.restart_range();
    return step(0.011 + 0.002 * std::min(tick, 10000) / 10000.0);
  };
  LONGS_EQUAL(-1, ticks_until(in_draught, 20000));
  // A muscle lost after it has answered is found at the end of the window.
  LONGS_EQUAL(20000, ticks_until([&](int tick) {
                if (tick == 10000) detector.restart_range();
                return step(0.011 + 0.004 * tick / 20000.0);
              }));
}

TEST(HeaterDetectors, StuckOnAllows50MillisecondsByDefault) {
  StuckOn detector({.max_A = 0.02}, tick_s);
  LONGS_EQUAL(50, ticks_until([&](int) { return detector.step(true, 0.4); }));
}
