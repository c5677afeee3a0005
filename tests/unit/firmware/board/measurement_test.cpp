#include "board/measurement.hpp"

#include <CppUTest/TestHarness.h>

using namespace supercoil;
using namespace supercoil::board;
using namespace std::chrono_literals;

TEST_GROUP(Measurement){};

TEST(Measurement, CountsBecomeUnitsWithTheirAge) {
  const Measured m = measure({1000, 5ms, hal::Status::ok}, {1e-5, 0.002}, 7ms, 0.01);
  CHECK(m.present);
  DOUBLES_EQUAL(0.012, m.value, 1e-12);
  DOUBLES_EQUAL(0.002, m.age_s, 1e-12);
}

TEST(Measurement, TooOldIsAbsentAndNotTheOldNumber) {
  const Measured m = measure({1000, 0ms, hal::Status::ok}, {1e-5, 0.0}, 11ms, 0.01);
  CHECK_FALSE(m.present);
  DOUBLES_EQUAL(0.0, m.value, 0.0);
}

TEST(Measurement, FromTheFutureIsAbsent) {
  CHECK_FALSE(measure({1, 8ms, hal::Status::ok}, {}, 7ms, 0.01).present);
}

TEST(Measurement, WithAnErrorIsAbsentAndSaysWhy) {
  const Measured m = measure({1, 7ms, hal::Status::gone}, {}, 7ms, 0.01);
  CHECK_FALSE(m.present);
  CHECK(m.status == hal::Status::gone);
}

TEST_GROUP(Resistance){};

TEST(Resistance, IsDutyTimesVoltageOverAveragedCurrent) {
  Resistance r({0.02, 0.5, 100.0});
  CHECK(r.step(0.25, 12.0, 0.3, 1e-3));
  DOUBLES_EQUAL(10.0, r.value_Ohm(), 1e-12);
}

TEST(Resistance, HoldsItsLastValueWithItsAgeBelowTheProbeDuty) {
  Resistance r({0.02, 0.5, 100.0});
  r.step(0.25, 12.0, 0.3, 1e-3);
  for (int i = 0; i < 10; ++i)
    CHECK_FALSE(r.step(0.01, 12.0, 0.012, 1e-3));
  DOUBLES_EQUAL(10.0, r.value_Ohm(), 1e-12);
  DOUBLES_EQUAL(0.010, r.age_s(), 1e-9);
}

TEST(Resistance, OutsideItsRangeIsNotTaken) {
  Resistance r({0.02, 0.5, 100.0});
  CHECK_FALSE(r.step(0.02, 12.0, 0.001, 1e-3));
  CHECK_FALSE(r.plausible());
  DOUBLES_EQUAL(0.0, r.value_Ohm(), 0.0);
  r.step(0.02, 12.0, 0.024, 1e-3);
  CHECK(r.plausible());
  CHECK_FALSE(r.step(0.5, 12.0, 100.0, 1e-3));
  CHECK_FALSE(r.plausible());
  DOUBLES_EQUAL(10.0, r.value_Ohm(), 1e-12);
}
