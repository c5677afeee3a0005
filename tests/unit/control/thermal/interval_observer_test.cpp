#include "supercoil/control/thermal/interval_observer.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>
#include <rapidcheck.h>

#include "unit/control/support/generators.hpp"

using namespace supercoil;
using control::IntervalObserver;
using control::ThermalBounds;

namespace {

constexpr double slow_step_s = 0.01;
constexpr ThermalBounds bounds{0.12, 0.20, 0.06, 0.20};
/// True power over measured power.
constexpr double min_ratio = 0.95;
constexpr double max_ratio = 1.05;

double uniform(double low, double high) {
  return *test::reals(low, high);
}

}  // namespace

TEST_GROUP(IntervalObserver){};

TEST(IntervalObserver, ContainsTheTruthWhileTheMuscleChanges) {
  CHECK(rc::check("random muscles, also changing ones, and random powers", [] {
    IntervalObserver observer(bounds, slow_step_s);
    double truth_K = 0.0;
    for (int stretch = 0; stretch < 12; ++stretch) {
      const double mass = uniform(bounds.min_mass_J_per_K, bounds.max_mass_J_per_K);
      const double transfer = uniform(bounds.min_transfer_W_per_K, bounds.max_transfer_W_per_K);
      const double ratio = uniform(min_ratio, max_ratio);
      const double power_W = *rc::gen::element(0.0, uniform(0.0, 4.5), 4.5);
      for (int tick = 0; tick < 100; ++tick) {
        const double rest_K = ratio * power_W / transfer;
        truth_K = rest_K + (truth_K - rest_K) * std::exp(-transfer / mass * slow_step_s);
        observer.step(min_ratio * power_W, max_ratio * power_W);
        RC_ASSERT(observer.min_K() <= truth_K + 1e-9);
        RC_ASSERT(observer.max_K() >= truth_K - 1e-9);
      }
    }
  }));
}

TEST(IntervalObserver, ForAKnownMuscleIsItsExactTemperature) {
  IntervalObserver observer({0.162, 0.162, 0.089, 0.089}, slow_step_s);
  for (int tick = 0; tick < 182; ++tick)
    observer.step(4.5);
  const double expected_K = 4.5 / 0.089 * (1.0 - std::exp(-0.089 / 0.162 * 1.82));
  DOUBLES_EQUAL(expected_K, observer.max_K(), 1e-9);
  DOUBLES_EQUAL(expected_K, observer.min_K(), 1e-9);
}

TEST(IntervalObserver, IsHotterWhileCoolingThanAnObserverWithBothLowerBounds) {
  // The two lower bounds alone are not enough: after a pulse a heavier muscle stays hot longer.
  IntervalObserver observer({0.12, 0.20, 0.06, 0.06}, slow_step_s);
  double light_K = 0.0;
  double heavy_K = 0.0;
  for (int tick = 0; tick < 2000; ++tick) {
    const double power_W = tick < 1000 ? 4.5 : 0.0;
    observer.step(power_W);
    light_K += (power_W / 0.06 - light_K) * (1.0 - std::exp(-0.06 / 0.12 * slow_step_s));
    heavy_K += (power_W / 0.06 - heavy_K) * (1.0 - std::exp(-0.06 / 0.20 * slow_step_s));
  }
  CHECK_COMPARE(light_K, <, heavy_K);
  CHECK_COMPARE(observer.max_K(), >=, heavy_K);
}

TEST(IntervalObserver, AfterAnUnknownPastTheIntervalReachesTheGivenLimit) {
  IntervalObserver observer(bounds, slow_step_s);
  observer.reset(140.0);
  DOUBLES_EQUAL(0.0, observer.min_K(), 0.0);
  DOUBLES_EQUAL(140.0, observer.max_K(), 0.0);
}
