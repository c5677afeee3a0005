#include <cmath>

#include <CppUTest/TestHarness.h>

#include "supervisor/detectors/sensor.hpp"
#include "unit/firmware/core/support/tick.hpp"

using namespace supercoil::detectors;
using supercoil::test::tick_s;

namespace {
const double nan_value = std::nan("");
}  // namespace

TEST_GROUP(SensorDetectors){};

TEST(SensorDetectors, OutOfRangeTripsAfterItsTimeAndNotForASingleOutlier) {
  OutOfRange detector({0.0, 0.04, 0.005}, tick_s);
  CHECK_FALSE(detector.step(0.05));
  for (int i = 0; i < 4; ++i)
    CHECK_FALSE(detector.step(0.02));
  for (int i = 0; i < 4; ++i)
    CHECK_FALSE(detector.step(-0.001));
  CHECK(detector.step(-0.001));
}

TEST(SensorDetectors, OutOfRangeTripsForALooseWireThatComesAndGoes) {
  OutOfRange detector({0.0, 0.04, 0.005}, tick_s);
  bool tripped = false;
  for (int i = 0; i < 20; ++i)
    tripped = detector.step(i % 2 == 0 ? -0.001 : 0.02) || tripped;
  CHECK(tripped);
}

TEST(SensorDetectors, JumpTripsForABadContactThatComesAndGoes) {
  Jump detector({0.5, 100e-6});
  bool tripped = false;
  for (int i = 0; i < 10; ++i)
    tripped = detector.step(i % 2 == 0 ? 0.010 : 0.018, 1e-3) || tripped;
  CHECK(tripped);
}

TEST(SensorDetectors, OutOfRangeTripsForNaN) {
  OutOfRange detector({0.0, 0.04, 0.002}, tick_s);
  CHECK_FALSE(detector.step(nan_value));
  CHECK(std::isinf(detector.margin().used()));
  CHECK(detector.step(nan_value));
}

TEST(SensorDetectors, OutOfRangeMarginIsTheDistanceToTheLimit) {
  OutOfRange detector({0.0, 0.04, 0.005}, tick_s);
  detector.step(0.03);
  DOUBLES_EQUAL(0.5, detector.margin().used(), 1e-9);
}

TEST(SensorDetectors, AFlagTripsAtOnceAndUsesAllOfItsMarginOrNone) {
  Flag detector;
  CHECK_FALSE(detector.step(false));
  DOUBLES_EQUAL(0.0, detector.margin().used(), 0.0);
  CHECK(detector.step(true));
  CHECK(std::isinf(detector.margin().used()));
}

TEST(SensorDetectors, FrozenTripsOnlyWhileHot) {
  Frozen detector({1e-6, 0.1}, tick_s);
  for (int i = 0; i < 500; ++i)
    CHECK_FALSE(detector.step(0.01, false));
  int ticks = 0;
  while (!detector.step(0.01, true))
    ++ticks;
  LONGS_EQUAL(99, ticks);
}

TEST(SensorDetectors, FrozenDoesNotTripForALiveSensor) {
  Frozen detector({1e-6, 0.1}, tick_s);
  for (int i = 0; i < 1000; ++i) {
    CHECK_FALSE(detector.step(0.01 + (i % 3 == 0 ? 3e-6 : -3e-6), true));
  }
}

TEST(SensorDetectors, JumpTripsWhenTheReadingStaysAway) {
  Jump detector({0.5, 1e-4});
  CHECK_FALSE(detector.step(0.010, tick_s));
  CHECK_FALSE(detector.step(0.0105, tick_s));
  CHECK_FALSE(detector.step(0.020, tick_s));
  CHECK(detector.step(0.020, tick_s));
}

TEST(SensorDetectors, JumpForgivesOneGlitch) {
  Jump detector({0.5, 1e-4});
  detector.step(0.010, tick_s);
  CHECK_FALSE(detector.step(0.035, tick_s));
  CHECK_FALSE(detector.step(0.010, tick_s));
  CHECK_FALSE(detector.step(0.010, tick_s));
}

TEST(SensorDetectors, JumpAllowsWhatAMuscleCanMoveBetweenReadings) {
  Jump detector({0.5, 1e-4});
  detector.step(0.010, tick_s);
  CHECK_FALSE(detector.step(0.0149, 0.01));
  DOUBLES_EQUAL(0.0049 / 0.0051, detector.margin().used(), 1e-9);
}

TEST(SensorDetectors, DisagreeTripsAfterItsTime) {
  SensorsDisagree detector({20.0, 0.003}, tick_s);
  CHECK_FALSE(detector.step(50.0, 75.0));
  CHECK_FALSE(detector.step(50.0, 75.0));
  CHECK(detector.step(50.0, 75.0));
  CHECK_FALSE(detector.step(50.0, 65.0));
}

TEST(SensorDetectors, JumpIgnoresTheFirstReading) {
  Jump detector({0.5, 1e-4});
  CHECK_FALSE(detector.step(0.010, tick_s));
  DOUBLES_EQUAL(0.0, detector.margin().measured, 0.0);
  CHECK_COMPARE(detector.margin().limit, >, 0.0);
}
