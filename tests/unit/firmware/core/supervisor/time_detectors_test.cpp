#include <cmath>

#include <CppUTest/TestHarness.h>

#include "supervisor/detectors/liveness.hpp"
#include "unit/firmware/core/support/tick.hpp"

using namespace supercoil::detectors;
using supercoil::test::tick_s;

namespace {}

TEST_GROUP(TimeDetectors){};

TEST(TimeDetectors, ConsecutiveCountResetsAtEachGoodOne) {
  ConsecutiveCount detector(3);
  CHECK_FALSE(detector.step(true));
  CHECK_FALSE(detector.step(true));
  CHECK_FALSE(detector.step(false));
  CHECK_FALSE(detector.step(true));
  CHECK_FALSE(detector.step(true));
  CHECK(detector.step(true));
}

TEST(TimeDetectors, SilentTripsWhenTheCounterStalls) {
  StalledCounter detector(0.01, tick_s);
  for (std::uint32_t i = 1; i < 100; ++i)
    CHECK_FALSE(detector.step(i));
  for (int i = 0; i < 9; ++i)
    CHECK_FALSE(detector.step(99));
  CHECK(detector.step(99));
  CHECK_FALSE(detector.step(100));
}

TEST(TimeDetectors, ExpiredTripsForACommandThatIsNotRenewed) {
  CommandTimeout detector(0.25, tick_s);
  CHECK_FALSE(detector.step(true, true));
  for (int i = 0; i < 250; ++i)
    CHECK_FALSE(detector.step(false, true));
  CHECK(detector.step(false, true));
}

TEST(TimeDetectors, ExpiredDoesNotTripWhileRenewedOrCold) {
  CommandTimeout detector(0.25, tick_s);
  for (int i = 0; i < 5000; ++i)
    CHECK_FALSE(detector.step(i % 250 == 0, true));
  for (int i = 0; i < 5000; ++i)
    CHECK_FALSE(detector.step(false, false));
}

TEST(TimeDetectors, AControllerIsLostWhenItHasWantedMoreForTooLong) {
  ControllerSaturated detector(0.01, tick_s);
  for (int i = 0; i < 9; ++i)
    CHECK_FALSE(detector.step(4.5, true));
  CHECK_FALSE(detector.step(4.5, false));
  for (int i = 0; i < 9; ++i)
    CHECK_FALSE(detector.step(4.5, true));
  DOUBLES_EQUAL(0.9, detector.margin().used(), 1e-9);
  CHECK(detector.step(4.5, true));
  detector.reset();
  CHECK_FALSE(detector.step(4.5, true));
}

TEST(TimeDetectors, AControllerIsLostAtOnceWhenItDemandsNaN) {
  ControllerSaturated detector(10.0, tick_s);
  CHECK(detector.step(std::nan(""), false));
  CHECK(std::isinf(detector.margin().used()));
  CHECK(detector.step(INFINITY, false));
  CHECK(std::isinf(detector.margin().used()));
  CHECK_FALSE(detector.step(1.0, false));
}

TEST(TimeDetectors, ACounterThatNeverMovedIsDetectedInTheSameTime) {
  StalledCounter detector(0.01, tick_s);
  for (int i = 0; i < 9; ++i)
    CHECK_FALSE(detector.step(0));
  CHECK(detector.step(0));
}
