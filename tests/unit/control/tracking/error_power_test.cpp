// The power that an error takes, in cases with a known answer.
#include "supercoil/control/tracking/error_power.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>

using supercoil::control::ErrorPower;
using supercoil::control::Theta;

TEST_GROUP(ErrorPower){};

TEST(ErrorPower, IsThePowerOfTheErrorsOwnMotion) {
  constexpr double period_s = 0.01;
  constexpr double pole_rad_per_s = 3.0;
  const Theta units{0.5, 0.2, 2.0, 1.0};
  ErrorPower power;
  double time_s = 0.0;
  for (int k = 0; k < 1000; ++k) {
    for (int tick = 0; tick < 10; ++tick, time_s += 1e-3)
      power.step(0.01 * time_s * time_s);
    power.update(10.0, 1.0 - std::exp(-pole_rad_per_s * period_s), period_s);
  }
  // On a ramp the low-passes lag by two time constants, and the mean by half a period.
  const double late_s = time_s - 2.0 / pole_rad_per_s;
  const double position = 0.01 * (late_s * late_s + 2.0 / (pole_rad_per_s * pole_rad_per_s));
  const double expected_W = position * units[3] + 0.02 * late_s * units[2] + 0.02 * units[1];
  DOUBLES_EQUAL(expected_W, power.power_W(units), 0.005 * expected_W);
  power.restart();
  DOUBLES_EQUAL(0.0, power.power_W(units), 0.0);
}
