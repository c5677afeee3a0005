#include "board/measurement.hpp"

#include <CppUTest/TestHarness.h>

using namespace supercoil;
using namespace supercoil::board;
using namespace std::chrono_literals;

namespace {

Measured measured(const hal::Sample& sample, const Scaling& scaling, hal::Time now,
                  double max_age_s) {
  Measured result;
  measure(sample, scaling, now, max_age_s, result);
  return result;
}

}  // namespace

TEST_GROUP(Measurement){};

TEST(Measurement, CountsBecomeUnitsWithTheirAge) {
  const Measured m = measured({1000, 5ms, hal::Status::ok}, {1e-5, 0.002}, 7ms, 0.01);
  CHECK(m.present);
  DOUBLES_EQUAL(0.012, m.value, 1e-12);
  DOUBLES_EQUAL(0.002, m.age_s, 1e-12);
}

TEST(Measurement, TooOldIsAbsentWithoutTheOldValue) {
  const Measured m = measured({1000, 0ms, hal::Status::ok}, {1e-5, 0.0}, 11ms, 0.01);
  CHECK_FALSE(m.present);
  DOUBLES_EQUAL(0.0, m.value, 0.0);
}

TEST(Measurement, JustAfterTheTicksStartIsFresh) {
  const Measured m = measured({1, 8ms, hal::Status::ok}, {}, 7ms, 0.01);
  CHECK(m.present);
  DOUBLES_EQUAL(0.0, m.age_s, 0.0);
}

TEST(Measurement, FromTheFutureIsAbsent) {
  CHECK_FALSE(measured({1, 18ms, hal::Status::ok}, {}, 7ms, 0.01).present);
}

TEST(Measurement, WithAnErrorIsAbsentWithTheReason) {
  const Measured m = measured({1, 7ms, hal::Status::gone}, {}, 7ms, 0.01);
  CHECK_FALSE(m.present);
  CHECK(m.status == hal::Status::gone);
}

TEST(Measurement, ThatWasNeverMadeIsAbsent) {
  const Measured m;
  CHECK_FALSE(m.present);
  CHECK(m.status == hal::Status::not_ready);
  DOUBLES_EQUAL(0.0, m.value, 0.0);
}
