#include "board/resistance.hpp"

#include <CppUTest/TestHarness.h>

#include "board/probe.hpp"
#include "unit/firmware/core/support/tick.hpp"

using supercoil::board::Probe;
using supercoil::board::Resistance;
using supercoil::test::tick_s;

TEST_GROUP(Resistance){};

TEST(Resistance, IsDutyTimesVoltageOverAveragedCurrent) {
  Resistance r({}, tick_s);
  CHECK(r.step(0.25, 12.0, 0.25));
  DOUBLES_EQUAL(12.0, r.value_Ohm(), 1e-12);
  DOUBLES_EQUAL(0.0, r.age_s(), 0.0);
}

TEST(Resistance, IsStaleUntilMeasured) {
  const Resistance r({}, tick_s);
  CHECK(r.age_s() > 1e6);
}

TEST(Resistance, HoldsItsLastValueWithItsAgeBelowTheProbeDuty) {
  Resistance r({}, tick_s);
  r.step(0.25, 12.0, 0.25);
  for (int i = 0; i < 10; ++i)
    CHECK_FALSE(r.step(0.01, 12.0, 0.012));
  DOUBLES_EQUAL(12.0, r.value_Ohm(), 1e-12);
  DOUBLES_EQUAL(0.010, r.age_s(), 1e-9);
}

TEST(Resistance, IsNotMisledByTheSenseFilterWhileTheDutyChanges) {
  constexpr double filter_s = 0.01;
  Resistance::Settings settings;
  settings.sense_filter_s = filter_s;
  Resistance r(settings, tick_s);
  double sense_A = 0.0;
  const double part = 1.0 - std::exp(-tick_s / filter_s);
  for (int i = 0; i < 2000; ++i) {
    const double duty = i % 200 < 100 ? 0.3 : 0.05;
    sense_A += part * (duty * 12.0 / 8.0 - sense_A);
    r.step(duty, 12.0, sense_A);
  }
  DOUBLES_EQUAL(8.0, r.value_Ohm(), 1e-9);
}

TEST(Resistance, SmoothsNoise) {
  Resistance r({}, tick_s);
  for (int i = 0; i < 3000; ++i)
    r.step(0.1, 12.0, i % 2 == 0 ? 0.13 : 0.11);
  DOUBLES_EQUAL(10.0, r.value_Ohm(), 0.02);
}

TEST(Resistance, OutOfRangeMeasurementsAreIgnored) {
  Resistance::Settings settings;
  settings.initial_Ohm = 9.0;
  Resistance r(settings, tick_s);
  CHECK_FALSE(r.step(0.5, 12.0, 1000.0));
  DOUBLES_EQUAL(9.0, r.value_Ohm(), 0.0);
}

TEST(Resistance, TakesOverTheResultOfAProbe) {
  Resistance r({}, tick_s);
  r.step(0.25, 12.0, 0.25);
  r.set(7.0);
  DOUBLES_EQUAL(7.0, r.value_Ohm(), 0.0);
  DOUBLES_EQUAL(0.0, r.age_s(), 0.0);
}

TEST(Resistance, FirstMeasurementAfterAProbeIsNotSmoothed) {
  Resistance r({}, tick_s);
  r.step(0.25, 12.0, 0.25);
  r.set(7.0);
  CHECK(r.step(0.25, 12.0, 0.5));
  DOUBLES_EQUAL(6.0, r.value_Ohm(), 1e-12);
}

TEST_GROUP(Probe){};

TEST(Probe, MeasuresInItsSecondHalfAndEnds) {
  Probe probe(0.05, tick_s);
  probe.start();
  int ticks = 0;
  Probe::Result result;
  while (!result.ended) {
    ++ticks;
    // The first half is still wrong because the sense has not settled.
    result = probe.step(0.02, 12.0, ticks <= 25 ? 0.005 : 0.024);
  }
  LONGS_EQUAL(50, ticks);
  DOUBLES_EQUAL(10.0, result.resistance_Ohm, 1e-9);
  CHECK_FALSE(probe.running());
}

TEST(Probe, WithoutCurrentGivesNoResistance) {
  Probe probe(0.05, tick_s);
  probe.start();
  Probe::Result result;
  while (!result.ended)
    result = probe.step(0.02, 12.0, 0.0);
  DOUBLES_EQUAL(0.0, result.resistance_Ohm, 0.0);
}

TEST(Probe, DoesNothingUntilItIsStarted) {
  Probe probe(0.05, tick_s);
  CHECK_FALSE(probe.step(0.02, 12.0, 0.024).ended);
}
