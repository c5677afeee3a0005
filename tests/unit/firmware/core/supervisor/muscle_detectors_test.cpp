#include <cmath>

#include <CppUTest/TestHarness.h>

#include "supervisor/detectors/limits.hpp"
#include "supervisor/detectors/muscle.hpp"
#include "unit/firmware/core/support/tick.hpp"

using namespace supercoil::detectors;
using supercoil::test::tick_s;

namespace {}

TEST_GROUP(MuscleDetectors){};

TEST(MuscleDetectors, LimitTripsAtOnceAndForNaN) {
  Limit detector(160.0);
  CHECK_FALSE(detector.step(160.0));
  DOUBLES_EQUAL(1.0, detector.margin().used(), 1e-12);
  CHECK(detector.step(160.1));
  CHECK(detector.step(std::nan("")));
}

TEST(MuscleDetectors, EnergyBudgetAllowsItsMeanPowerIndefinitely) {
  EnergyBudget detector({60.0, 30.0}, tick_s);
  for (int i = 0; i < 500000; ++i)
    CHECK_FALSE(detector.step(1.999));
  DOUBLES_EQUAL(0.9995, detector.margin().used(), 1e-3);
}

TEST(MuscleDetectors, EnergyBudgetTripsForTooLongABurst) {
  EnergyBudget detector({60.0, 30.0}, tick_s);
  int ticks = 0;
  while (!detector.step(4.0))
    ++ticks;
  // 1 − e^(−t/30) = 60/(4·30)
  DOUBLES_EQUAL(30.0 * std::log(2.0), ticks * tick_s, 0.01);
}

TEST(MuscleDetectors, ResistanceDriftTripsBothWays) {
  ResistanceDrift detector({0.2, 0.003}, tick_s);
  const auto probed = [&](double measured_Ohm) {
    return detector.step(measured_Ohm, 10.0, 11.0, true);
  };
  CHECK_FALSE(probed(13.1));
  CHECK(probed(13.3));
  DOUBLES_EQUAL(13.3 / 13.2, detector.margin().used(), 1e-12);
  CHECK_FALSE(probed(8.1));
  CHECK(probed(7.9));
  DOUBLES_EQUAL(8.0 / 7.9, detector.margin().used(), 1e-12);
  CHECK(probed(std::nan("")));
}

TEST(MuscleDetectors, ResistanceDriftOfAHeatingMuscleMustPersist) {
  ResistanceDrift detector({0.2, 0.003}, tick_s);
  const auto heating = [&](double measured_Ohm) {
    return detector.step(measured_Ohm, 10.0, 11.0, false);
  };
  CHECK_FALSE(heating(20.0));
  CHECK_FALSE(heating(20.0));
  detector.skip();
  CHECK_FALSE(heating(20.0));
  CHECK_FALSE(heating(20.0));
  CHECK(heating(20.0));
}

TEST(MuscleDetectors, SupplyTripsAboveAndBelowItsLimitsAfterTheirTime) {
  Above over({14.0, 0.003}, tick_s);
  CHECK_FALSE(over.step(15.0));
  CHECK_FALSE(over.step(15.0));
  CHECK(over.step(15.0));
  CHECK_FALSE(over.step(13.0));
  Below under({10.0, 0.003}, tick_s);
  CHECK_FALSE(under.step(9.0));
  CHECK_FALSE(under.step(9.0));
  CHECK(under.step(9.0));
  DOUBLES_EQUAL(10.0 / 9.0, under.margin().used(), 1e-12);
  CHECK_FALSE(under.step(10.0));
  CHECK_FALSE(under.step(0.0));
  CHECK(std::isinf(under.margin().used()));
}
