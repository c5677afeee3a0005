#include "loop/estimation.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>

#include "unit/firmware/core/support/tick.hpp"

using namespace supercoil;
using supercoil::test::tick_s;

namespace {

std::vector<control::EstimatorSettings> two_alike() {
  control::EstimatorSettings one;
  const control::Theta& nominal = one.gradient.scale.nominal;
  one.gradient.initial = nominal * 0.7;
  one.gradient.bounds = control::Box<double, 4>{nominal * 0.2, nominal * 5.0};
  return {one, one};
}

/// Moves a muscle from one tick to another.
void move(Estimation& estimation, int from, int to) {
  for (int i = from; i < to; ++i) {
    const double angle = 2.0 * tick_s * i;
    estimation.step(0.010 + 0.004 * std::sin(angle - 1.0), 2.0 + std::sin(angle));
  }
}

}  // namespace

TEST_GROUP(Estimation){};

TEST(Estimation, StartsWithItsFirstEstimator) {
  Estimation estimation(two_alike(), tick_s);
  LONGS_EQUAL(2, estimation.estimators());
  LONGS_EQUAL(0, estimation.chosen());
  CHECK(estimation.estimate().has_value());
  CHECK_FALSE(estimation.trusted());
  estimation.choose(1);
  LONGS_EQUAL(1, estimation.chosen());
}

TEST(Estimation, ChoosingAnEstimatorRestartsItsFiltersAndKeepsItsParameters) {
  Estimation chosen(two_alike(), tick_s);
  Estimation restarted(two_alike(), tick_s);
  Estimation goes_on(two_alike(), tick_s);
  for (Estimation* each : {&chosen, &restarted, &goes_on})
    move(*each, 0, 3000);
  const control::Theta learned = chosen.estimate()->theta;
  chosen.choose(0);
  CHECK(chosen.estimate()->theta == learned);
  restarted.restart();
  for (Estimation* each : {&chosen, &restarted, &goes_on})
    move(*each, 3000, 3500);
  CHECK(chosen.estimate()->theta == restarted.estimate()->theta);
  CHECK(chosen.estimate()->theta != goes_on.estimate()->theta);
}
