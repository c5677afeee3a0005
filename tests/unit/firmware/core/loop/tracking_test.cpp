#include "loop/tracking.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>

#include "unit/firmware/core/support/tick.hpp"

using namespace supercoil;
using supercoil::test::tick_s;

namespace {

constexpr double held_m = 0.010;

std::vector<control::ControllerSettings> two_laws() {
  std::vector<control::ControllerSettings> laws(2);
  laws[0].kind = control::ControllerKind::pi;
  laws[1].kind = control::ControllerKind::pd_ff;
  for (control::ControllerSettings& law : laws)
    law.model = control::design_model();
  return laws;
}

}  // namespace

TEST_GROUP(Smoothed){};

TEST(Smoothed, StartsAtZeroAndFollowsARampWithoutLag) {
  Smoothed smoothed(0.05, tick_s);
  DOUBLES_EQUAL(0.0, smoothed.value(), 0.0);
  for (int i = 0; i <= 1000; ++i)
    smoothed.step(2.0 * tick_s * i);
  DOUBLES_EQUAL(2.0 * tick_s * 1000, smoothed.value(), 1e-6);
}

TEST(Smoothed, TakesHalfOfAJumpInAStepOfOneTimeConstant) {
  Smoothed smoothed(tick_s, tick_s);
  smoothed.step(1.0);
  DOUBLES_EQUAL(2.0 * 0.5 - 0.25, smoothed.value(), 1e-12);
}

/// A muscle at rest at its reference, with the power that holds it there.
TEST_GROUP(Tracking) {
  control::PhysicalParameters muscle;
  Tracking tracking{two_laws(), muscle, tick_s};
  double holding_W = held_m / muscle.dc_gain_m_per_W();

  control::ControllerOutput tick() {
    control::ControllerInput input;
    input.reference_m = input.position_m = held_m;
    input.applied_power_W = holding_W;
    input.range = {0.0, 4.5};
    return tracking.step(input, {});
  }
  void start() {
    tracking.set_power(holding_W);
    tracking.start(held_m, held_m, true, muscle);
  }
};

TEST(Tracking, StaysAtRestWhenStartedAtTheReference) {
  start();
  for (int i = 0; i < 2000; ++i) {
    const control::ControllerOutput output = tick();
    DOUBLES_EQUAL(held_m, output.model_m, 1e-9);
    DOUBLES_EQUAL(holding_W, output.demanded_power_W, 0.01);
  }
}

TEST(Tracking, KeepsItsModelStateWhenAnotherLawTakesOver) {
  for (const int ticks : {2, 1000}) {
    start();
    for (int i = 0; i < ticks; ++i)
      tick();
    const std::size_t next = 1 - tracking.chosen();
    tracking.take_over(next, held_m, muscle);
    LONGS_EQUAL(next, tracking.chosen());
    for (int i = 0; i < 2000; ++i) {
      const control::ControllerOutput output = tick();
      DOUBLES_EQUAL(held_m, output.model_m, 1e-9);
      DOUBLES_EQUAL(holding_W, output.demanded_power_W, 0.01);
    }
  }
}
