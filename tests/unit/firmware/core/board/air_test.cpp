// The air's share of a muscle's temperature stays between both ends, whatever the air does.
#include "board/air.hpp"

#include <cmath>
#include <random>

#include <CppUTest/TestHarness.h>

#include "unit/firmware/core/support/tick.hpp"

using namespace supercoil;
using namespace supercoil::board;
using supercoil::test::tick_s;

namespace {

constexpr control::ThermalBounds air_bounds{0.13, 0.20, 0.045, 0.18};
constexpr double slowest_s = 0.20 / 0.045;

Measured air_read(double value_C) {
  return {value_C, 0.0, true, hal::Status::ok};
}

}  // namespace

TEST_GROUP(Air) {
  AirSettings settings{30.0, 15.0, 2.0};
  Air air{settings, air_bounds, tick_s};

  void read_for(double value_C, double time_s) {
    for (long i = std::lround(time_s / tick_s); i > 0; --i)
      air.step(air_read(value_C));
  }
};

TEST(Air, IsAsConfiguredBeforeTheFirstReading) {
  DOUBLES_EQUAL(30.0, air.warmest_C(), 0.0);
  DOUBLES_EQUAL(15.0, air.coldest_C(), 0.0);
  DOUBLES_EQUAL(0.0, air.above_configured_K(), 0.0);
}

TEST(Air, ConvergesToTheReadingAndItsError) {
  read_for(20.0, slowest_s);
  DOUBLES_EQUAL(22.0 + 8.0 * std::exp(-1.0), air.warmest_C(), 1e-3);
  DOUBLES_EQUAL(18.0 - 3.0 * std::exp(-1.0), air.coldest_C(), 1e-3);
  read_for(20.0, 20.0 * slowest_s);
  DOUBLES_EQUAL(22.0, air.warmest_C(), 1e-6);
  DOUBLES_EQUAL(18.0, air.coldest_C(), 1e-6);
}

TEST(Air, WidensAtOnce) {
  read_for(45.0, tick_s);
  DOUBLES_EQUAL(47.0, air.warmest_C(), 0.0);
  DOUBLES_EQUAL(17.0, air.above_configured_K(), 1e-12);
  read_for(-10.0, tick_s);
  DOUBLES_EQUAL(-12.0, air.coldest_C(), 0.0);
}

TEST(Air, IsNotNarrowedByReadingsBeyondTheConfiguredRange) {
  read_for(-60.0, 20.0 * slowest_s);
  DOUBLES_EQUAL(30.0, air.warmest_C(), 1e-9);
  DOUBLES_EQUAL(-62.0, air.coldest_C(), 1e-9);
  read_for(140.0, 20.0 * slowest_s);
  DOUBLES_EQUAL(142.0, air.warmest_C(), 1e-9);
  DOUBLES_EQUAL(15.0, air.coldest_C(), 1e-6);
}

TEST(Air, IsAsConfiguredWithoutASensor) {
  for (const Measured& nothing : {Measured{20.0, 9.0, false, hal::Status::ok}, air_read(NAN)}) {
    read_for(20.0, 20.0 * slowest_s);
    air.step(nothing);
    DOUBLES_EQUAL(30.0, air.warmest_C(), 0.0);
    DOUBLES_EQUAL(15.0, air.coldest_C(), 0.0);
  }
}

TEST(Air, ContainsTheTruthForEveryMuscleWithinTheBounds) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  const auto between = [&](double low, double high) { return low + (high - low) * part(random); };
  for (int muscle = 0; muscle < 50; ++muscle) {
    Air seen(settings, air_bounds, tick_s);
    const double pole_per_s = between(0.045, 0.18) / between(0.13, 0.20);
    const double keeps = std::exp(-tick_s * pole_per_s);
    double truth_C = between(15.0, 30.0);
    double filtered_C = truth_C;
    for (int i = 0; i < 20'000; ++i) {
      if (i % 1000 == 0) truth_C = between(-20.0, 70.0);
      truth_C += between(-0.02, 0.02);
      seen.step(air_read(truth_C + between(-2.0, 2.0)));
      filtered_C = truth_C + keeps * (filtered_C - truth_C);
      CHECK_COMPARE(filtered_C, <=, seen.warmest_C() + 1e-9);
      CHECK_COMPARE(filtered_C, >=, seen.coldest_C() - 1e-9);
    }
  }
}

TEST(Air, IsBetween15And25DegreesByDefault) {
  const Air indoors({}, air_bounds, tick_s);
  DOUBLES_EQUAL(25.0, indoors.warmest_C(), 0.0);
  DOUBLES_EQUAL(15.0, indoors.coldest_C(), 0.0);
}
