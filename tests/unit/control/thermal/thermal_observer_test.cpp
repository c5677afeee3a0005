#include "supercoil/control/thermal/thermal_observer.hpp"

#include <cmath>
#include <limits>

#include <CppUTest/TestHarness.h>

using supercoil::control::ThermalObserver;

TEST_GROUP(ThermalObserver){};

TEST(ThermalObserver, FollowsTheThermalEquationOfTheMuscle) {
  ThermalObserver observer(0.162, 1e-3);
  observer.learn(-0.089 / 0.162);
  for (int i = 0; i < 3000; ++i)
    observer.step(2.0);
  const double rest_K = 2.0 / 0.089;
  DOUBLES_EQUAL(rest_K * (1.0 - std::exp(-0.089 / 0.162 * 3.0)), observer.rise_K(), 1e-9);
}

TEST(ThermalObserver, ReportsNoRiseBeforeItHasLearned) {
  ThermalObserver observer(0.162, 1e-3);
  observer.step(100.0);
  DOUBLES_EQUAL(0.0, observer.rise_K(), 0.0);
}

TEST(ThermalObserver, DoesNotLearnAnUnstableOrAnAbsentPole) {
  ThermalObserver observer(0.162, 1e-3);
  observer.learn(-0.5);
  for (const double wrong : {0.0, 0.5, std::nan(""), -std::numeric_limits<double>::infinity()})
    observer.learn(wrong);
  for (int i = 0; i < 100000; ++i)
    observer.step(1.0);
  DOUBLES_EQUAL(1.0 / (0.5 * 0.162), observer.rise_K(), 1e-6);
}
