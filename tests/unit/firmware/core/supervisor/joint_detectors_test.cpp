// The detectors for a joint's muscles.
#include <cmath>

#include <CppUTest/TestHarness.h>

#include "supervisor/detectors/joint.hpp"
#include "unit/firmware/core/support/tick.hpp"

using namespace supercoil::detectors;
using supercoil::test::tick_s;

namespace {

constexpr NotResponding::Expected nothing{};

/// The models rise at 3 mm/s.
NotResponding::Expected rising(int tick) {
  const double expected_m = 0.003 * tick * tick_s;
  return {expected_m, expected_m, expected_m};
}

/// The first tick at which the step trips, counted from 1; -1: none within max_ticks.
template <class Step>
int tripped_at(Step step, int max_ticks = 100'000) {
  for (int tick = 0; tick < max_ticks; ++tick) {
    if (step(tick)) return tick + 1;
  }
  return -1;
}

}  // namespace

TEST_GROUP(JointDetectors) {
  MuscleLoose detector{{0.3, 0.003}, tick_s};

  bool step(bool limited, double position_m, const NotResponding::Expected& expected_m,
            const NotResponding::Expected& opposed_m) {
    return detector.step(limited, position_m, NotResponding::possible(expected_m, &opposed_m));
  }
};

TEST(JointDetectors, PossibleMotionsIncludeEveryGainOfTheOtherMuscle) {
  const NotResponding::Expected expected{0.010, 0.012, 0.004};
  const NotResponding::Expected opposed{0.003, 0.004, 0.001};
  const auto motions = NotResponding::possible(expected, &opposed);
  const std::size_t alone = NotResponding::steps + 2;
  DOUBLES_EQUAL(0.007, motions.m[0], 1e-12);
  DOUBLES_EQUAL(0.008, motions.m[1], 1e-12);
  DOUBLES_EQUAL(0.003, motions.m[alone - 1], 1e-12);
  double before = -1.0;
  for (std::size_t i = 0; i < NotResponding::gains.size(); ++i) {
    const double gain = NotResponding::gains[i];
    CHECK_COMPARE(gain, >, before);
    before = gain;
    DOUBLES_EQUAL(0.010 - gain * 0.003, motions.m[alone + i], 1e-12);
  }
  // For a single muscle nothing draws it back.
  DOUBLES_EQUAL(0.010, NotResponding::possible(expected).m[0], 1e-12);
}

TEST(JointDetectors, LooseTripsHalfASecondAfterMissingMotion) {
  const int ticks = tripped_at([&](int tick) { return step(true, 0.002, rising(tick), nothing); });
  CHECK_COMPARE(ticks, >=, 1499);
  CHECK_COMPARE(ticks, <=, 1502);
  CHECK(detector.margin().judged);
  DOUBLES_EQUAL(0.0, detector.margin().measured, 0.0);
}

TEST(JointDetectors, LooseIgnoresAMuscleThatGetsItsDemand) {
  LONGS_EQUAL(
      -1, tripped_at([&](int tick) { return step(false, 0.002, rising(tick), nothing); }, 20'000));
  CHECK_FALSE(detector.margin().judged);
  // Motion expected before that does not count.
  CHECK_FALSE(step(true, 0.002, rising(20'000), nothing));
  CHECK_FALSE(detector.margin().judged);
}

TEST(JointDetectors, LooseIgnoresAMuscleThatMovesTheJointAThirdAsFar) {
  LONGS_EQUAL(
      -1, tripped_at(
              [&](int tick) { return step(true, 0.35 * rising(tick)[0], rising(tick), nothing); },
              20'000));
}

TEST(JointDetectors, LooseRestartsWhereTheOtherMusclePullsTheJoint) {
  // The other muscle draws the joint to its end stop within 0.1 s.
  const int ticks = tripped_at([&](int tick) {
    const double position_m = tick < 1000 ? 0.002 : -0.006;
    return step(tick >= 500, position_m, rising(tick), nothing);
  });
  CHECK_COMPARE(ticks, >=, 2499);
  CHECK_COMPARE(ticks, <=, 2502);
}

TEST(JointDetectors, LooseIgnoresAMuscleThatTheOtherMayHoldStill) {
  LONGS_EQUAL(
      -1,
      tripped_at([&](int tick) { return step(true, 0.002, rising(tick), rising(tick)); }, 20'000));
}

TEST(JointDetectors, LooseTripsWhenTheJointMovesTheOtherWay) {
  // Three times one expected millimetre, without a pause: none of its models stands still.
  const int ticks = tripped_at(
      [&](int tick) { return step(true, 0.002 - 0.4 * rising(tick)[0], rising(tick), nothing); });
  CHECK_COMPARE(ticks, >=, 1000);
  CHECK_COMPARE(ticks, <=, 1010);
  // In the last expected millimetre: how far the joint went the other way, and the limit.
  const Margin margin = detector.margin();
  DOUBLES_EQUAL(0.0004, margin.measured, 5e-6);
  DOUBLES_EQUAL(0.0003, margin.limit, 5e-6);
  CHECK_COMPARE(margin.used(), >, 1.3);
  // Motion from before the muscle got what it asked for does not count.
  CHECK_FALSE(step(false, 0.0, rising(0), nothing));
  CHECK_FALSE(step(true, 0.0, rising(0), nothing));
}

TEST(JointDetectors, LooseIgnoresAMuscleThatALoadExtendsForAWhile) {
  // The wrong way for nearly three expected millimetres, then it follows; and so on.
  double position_m = 0.0;
  LONGS_EQUAL(-1, tripped_at(
                      [&](int tick) {
                        const double way = std::fmod(rising(tick)[0], 0.006) < 0.00285 ? -1.0 : 1.0;
                        position_m += way * 0.4 * rising(1)[0];
                        return step(true, position_m, rising(tick), nothing);
                      },
                      20'000));
}

/// Any model may explain it: a slow muscle that still cools, or an opposing one that is stronger.
TEST(JointDetectors, LooseIgnoresOppositeMotionThatAnyModelExplains) {
  using Expected = NotResponding::Expected;
  const auto moves_away = [&](const Expected& of_rise, const Expected& opposed_of_rise) {
    detector = MuscleLoose({0.3, 0.003}, tick_s);
    return tripped_at(
        [&](int tick) {
          const double rise_m = rising(tick)[0];
          Expected expected_m = of_rise;
          Expected opposed_m = opposed_of_rise;
          for (std::size_t i = 0; i < expected_m.size(); ++i) {
            expected_m[i] *= rise_m;
            opposed_m[i] *= rise_m;
          }
          return step(true, -0.4 * rise_m, expected_m, opposed_m);
        },
        20'000);
  };
  CHECK_COMPARE(moves_away({1.0, 1.0, 1.0}, {0.0, 0.0, 0.0}), >, 0);
  LONGS_EQUAL(-1, moves_away({1.0, 1.0, -0.1}, {0.0, 0.0, 0.0}));
  LONGS_EQUAL(-1, moves_away({1.0, -0.1, 1.0}, {0.0, 0.0, 0.0}));
  LONGS_EQUAL(-1, moves_away({1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}));
  LONGS_EQUAL(-1, moves_away({1.0, 1.0, 1.0}, {0.2, 0.2, 0.2}));
}
