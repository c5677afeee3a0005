#include "simulated_board/position_sensor.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>

using namespace supercoil::host_sim;

TEST_GROUP(PositionSensor){};

TEST(PositionSensor, HasTheNoiseThatItIsToldToHave) {
  PositionSensor sensor({10e-6, 0, 0.04}, 7);
  constexpr int count = 200000;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < count; ++i) {
    const double error = sensor.measure(0.02) - 0.02;
    sum += error;
    squares += error * error;
  }
  DOUBLES_EQUAL(0.0, sum / count, 1e-7);
  DOUBLES_EQUAL(10e-6, std::sqrt(squares / count), 1e-7);
}

TEST(PositionSensor, RoundsToItsSteps) {
  PositionSensor sensor({0.0, 8, 0.0255}, 1);
  DOUBLES_EQUAL(0.0101, sensor.measure(0.01012), 1e-15);
  DOUBLES_EQUAL(0.0102, sensor.measure(0.01016), 1e-15);
}

TEST(PositionSensor, ReadsItsEndsBeyondThem) {
  PositionSensor sensor({0.0, 16, 0.04}, 1);
  DOUBLES_EQUAL(0.04, sensor.measure(0.05), 1e-15);
  DOUBLES_EQUAL(0.0, sensor.measure(-0.01), 0.0);
}

TEST(PositionSensor, RepeatsItsNoiseForTheSameSeedOnly) {
  PositionSensor first({}, 3);
  PositionSensor same({}, 3);
  PositionSensor other({}, 4);
  int different = 0;
  for (int i = 0; i < 100; ++i) {
    const double reading = first.measure(0.01);
    DOUBLES_EQUAL(reading, same.measure(0.01), 0.0);
    different += reading != other.measure(0.01) ? 1 : 0;
  }
  CHECK_COMPARE(different, >, 90);
}

TEST(PositionSensor, GivesTheNumbersThatEveryPlatformGives) {
  // Recorded on x86-64, 2026-11: a change here changes every recorded run.
  PositionSensor sensor({1.0, 0, 1e9}, 1);
  DOUBLES_EQUAL(999.77229770, sensor.measure(1000.0), 1e-8);
  DOUBLES_EQUAL(999.74062275, sensor.measure(1000.0), 1e-8);
}
