#include "plant/effects.hpp"

#include <cmath>
#include <string>

#include <CppUTest/TestHarness.h>

#include "plant/guide_friction.hpp"
#include "plant/mechanics.hpp"
#include "plant/play_hysteresis.hpp"
#include "plant/wear.hpp"

using namespace supercoil;
using namespace supercoil::host_sim;

TEST_GROUP(PlantEffects){};

TEST(PlantEffects, AreAllOffByDefault) {
  CHECK_FALSE(PlantEffects{}.any());
  CHECK_FALSE(check(PlantEffects{}).has_value());
}

TEST(PlantEffects, AreRefusedOutOfRange) {
  for (const EffectRange& range : effect_ranges) {
    for (const double wrong : {range.min - 1e-6, range.max * 1.01 + 1.0, double(NAN)}) {
      PlantEffects effects;
      effects.*range.member = wrong;
      const auto violation = check(effects);
      CHECK(violation.has_value());
      STRCMP_EQUAL(range.name, violation->quantity);
    }
  }
}

TEST(PlantEffects, FractionsOfHeatTransferAddUpToAtMostOne) {
  PlantEffects effects;
  effects.convection_ratio = 0.7;
  effects.radiation_ratio = 0.31;
  STRCMP_EQUAL("radiation_ratio", check(effects)->quantity);
}

TEST(PlantEffects, SofteningEndsAboveItsStart) {
  PlantEffects effects;
  effects.softening_from_K = 60.0;
  STRCMP_EQUAL("softening_to_K", check(effects)->quantity);
}

TEST_GROUP(PlayHysteresis) {
  PlayHysteresis hysteresis;
  PlantEffects effects;
  void setup() override {
    effects.hysteresis_ratio = 0.15;
    effects.hysteresis_range_K = 70.0;
    hysteresis.set(effects);
  }
  double go(double from_K, double to_K, int steps = 1000) {
    double effective_K = 0.0;
    for (int i = 1; i <= steps; ++i)
      effective_K = hysteresis.step(from_K + (to_K - from_K) * i / steps);
    return effective_K;
  }
};

TEST(PlayHysteresis, FullLoopIsAsWideAsConfigured) {
  go(0.0, 100.0);
  go(100.0, 0.0);
  const double up_K = go(0.0, 50.0);
  go(50.0, 100.0);
  const double down_K = go(100.0, 50.0);
  DOUBLES_EQUAL(0.15 * 70.0, down_K - up_K, 1e-9);
}

TEST(PlayHysteresis, LoopAreaIsThatOfItsPlayOperators) {
  go(0.0, 70.0);
  go(70.0, 0.0);
  double area_K2 = 0.0;
  double last_K = hysteresis.step(0.0);
  const int steps = 20000;
  for (int i = 1; i <= 2 * steps; ++i) {
    const double rise_K = 70.0 * (i <= steps ? i : 2 * steps - i) / steps;
    const double now_K = hysteresis.step(rise_K);
    area_K2 += rise_K * (now_K - last_K);
    last_K = now_K;
  }
  double expected_K2 = 0.0;
  for (int j = 1; j <= 5; ++j) {
    const double radius_K = j / 5.0 * 0.15 * 70.0 / (1.2 * 0.5);
    expected_K2 += 0.5 / 5.0 * 2.0 * radius_K * (70.0 - 2.0 * radius_K);
  }
  DOUBLES_EQUAL(expected_K2, area_K2, 1e-3 * expected_K2);
}

TEST(PlayHysteresis, DoesNotDependOnSpeed) {
  const double slowly_K = (go(0.0, 60.0, 100000), go(60.0, 20.0, 100000));
  setup();
  hysteresis.rest_at(0.0);
  const double at_once_K = (go(0.0, 60.0, 1), go(60.0, 20.0, 1));
  DOUBLES_EQUAL(slowly_K, at_once_K, 1e-9);
}

TEST(PlayHysteresis, ForgetsASmallLoopInsideALargeOne) {
  const double rising_K = go(0.0, 40.0);
  const double before_K = go(40.0, 50.0);
  CHECK_COMPARE(go(50.0, 40.0), >, rising_K + 1.0);
  DOUBLES_EQUAL(before_K, go(40.0, 50.0), 1e-9);
}

TEST_GROUP(GuideFriction) {
  static constexpr double h_s = 0.25e-3;
  control::PhysicalParameters muscle;
  PlantEffects effects;
  GuideFriction friction;
  Mechanics mechanics;
  Motion motion;
  double pushed_N = 0.0;
  double coulomb_N = 0.0;
  void setup() override {
    effects.friction_ratio = 0.02;
    coulomb_N = 0.02 * 0.09 * 9.81;
    set();
  }
  void set() {
    friction.set(muscle, effects);
    mechanics.set(muscle, 0.0, h_s);
  }
  /// Without a spring, so that only friction holds the mass. The force changes linearly.
  void push(double force_N, double time_s) {
    const double step_N = (force_N - pushed_N) / static_cast<double>(std::lround(time_s / h_s));
    for (int i = 0; i < std::lround(time_s / h_s); ++i) {
      motion = friction.step(motion, {0.0, 0.0, pushed_N, pushed_N + step_N}, mechanics);
      pushed_N += step_N;
    }
  }
};

TEST(GuideFriction, HoldsWithoutDriftBelowStaticFriction) {
  push(0.9 * coulomb_N, 60.0);
  push(0.9 * coulomb_N, 5.0);
  const double rested_m = motion.position_m;
  // A bristle yields as it bends: z = z0 (1 − exp(−x/z0)); static friction would be at z0.
  const double max_m = 1.2 * effects.friction_bristle_m;
  DOUBLES_EQUAL(-max_m * std::log(1.0 - 0.9 / 1.2), rested_m, 1e-7);
  push(0.9 * coulomb_N, 100.0);
  DOUBLES_EQUAL(rested_m, motion.position_m, 1e-9);
  DOUBLES_EQUAL(0.0, motion.velocity_m_per_s, 1e-9);
}

TEST(GuideFriction, BreaksAwayAboveStaticFriction) {
  push(1.15 * coulomb_N, 60.0);
  CHECK_COMPARE(motion.position_m, <, 1e-4);
  push(1.25 * coulomb_N, 60.0);
  CHECK_COMPARE(motion.position_m, >, 3e-3);
}

TEST(GuideFriction, SlidesAgainstCoulombFriction) {
  push(5.0 * coulomb_N, 10.0);
  push(5.0 * coulomb_N, 10.0);
  const double expected_m_per_s = 4.0 * coulomb_N / muscle.damping_Ns_per_m;
  DOUBLES_EQUAL(expected_m_per_s, motion.velocity_m_per_s, 1e-6);
  DOUBLES_EQUAL(coulomb_N, friction.friction_N(motion.velocity_m_per_s), 1e-6);
}

TEST(GuideFriction, TurnsTheWorkOfASlowLoopIntoHeat) {
  // Moved to and fro by a stiff spring: the work that the damper does not take is friction's, which
  // is Coulomb's force times the path, except at the reversals.
  muscle.damping_Ns_per_m = 0.5;
  effects.friction_static_ratio = 1.0;
  set();
  constexpr double spring_N_per_m = 200.0;
  constexpr double amplitude_m = 0.01;
  const int steps_per_loop = 80000;
  double work_J = 0.0;
  double path_m = 0.0;
  double last_N = 0.0;
  for (int i = 1; i <= 2 * steps_per_loop; ++i) {
    const double now_N = spring_N_per_m * amplitude_m * std::sin(2.0 * M_PI * i / steps_per_loop);
    const double before_m = motion.position_m;
    motion = friction.step(motion, {spring_N_per_m, spring_N_per_m, last_N, now_N}, mechanics);
    if (i > steps_per_loop) {
      const double moved_m = motion.position_m - before_m;
      work_J += (0.5 * (last_N + now_N) - 0.5 * spring_N_per_m * (before_m + motion.position_m)) *
                    moved_m -
                muscle.damping_Ns_per_m * moved_m * moved_m / h_s;
      path_m += std::abs(moved_m);
    }
    last_N = now_N;
  }
  DOUBLES_EQUAL(4.0 * amplitude_m, path_m, 1e-3);
  DOUBLES_EQUAL(coulomb_N * path_m, work_J, 0.01 * coulomb_N * path_m);
}

TEST(GuideFriction, StaysBoundedAtAnySpeed) {
  motion = {0.0, 50.0};
  for (int i = 0; i < 4000; ++i) {
    motion = friction.step(motion, {16.0, 16.0, 0.0, 0.0}, mechanics);
    CHECK_COMPARE(std::abs(motion.velocity_m_per_s), <, 50.1);
    CHECK_COMPARE(std::abs(friction.bristle_m()), <=, 1.2 * effects.friction_bristle_m + 1e-12);
  }
}

TEST_GROUP(Mechanics){};

TEST(Mechanics, TheSeriesAndTheClosedFormAreTheSame) {
  // Where both are valid: the first by its own choice, the second because a limit is exceeded.
  for (const double damping : {0.0001, 0.05, 2.4, 2.0, 10.0}) {
    control::PhysicalParameters muscle;
    muscle.damping_Ns_per_m = damping;
    Mechanics series;
    Mechanics closed;
    series.set(muscle, 16.0, 1e-3);
    closed.set(muscle, 1e12, 1e-3);
    const Motion start{0.01, -0.03};
    const Drive drive{14.0, 15.0, 0.2, 0.25};
    const Motion a = series.step(start, drive);
    const Motion b = closed.step(start, drive);
    DOUBLES_EQUAL(a.position_m, b.position_m, 1e-13);
    DOUBLES_EQUAL(a.velocity_m_per_s, b.velocity_m_per_s, 1e-9);
  }
}

TEST_GROUP(Wear){};

TEST(Wear, LosesForceInProportionToItsCycles) {
  PlantEffects effects;
  effects.ageing_ratio = 0.02;
  Ageing ageing;
  ageing.set(effects);
  for (int cycle = 0; cycle < 10000; ++cycle) {
    ageing.step(effects.ageing_cycle_K);
    ageing.step(-effects.ageing_cycle_K);
  }
  DOUBLES_EQUAL(0.98, ageing.force_ratio(), 1e-9);
  effects.worn_cycles = 1e9;
  ageing.set(effects);
  DOUBLES_EQUAL(0.0, ageing.force_ratio(), 0.0);
}

TEST(Wear, WaterAddsForceUntilItIsDriedOut) {
  PlantEffects effects;
  effects.water_ratio = 0.04;
  Moisture moisture;
  moisture.set(effects, 1.0);
  DOUBLES_EQUAL(1.4, moisture.force_ratio(), 1e-12);
  for (int s = 0; s < 300; ++s)
    moisture.step(80.0);
  DOUBLES_EQUAL(1.0 + 0.4 * std::exp(-1.0), moisture.force_ratio(), 1e-9);
  for (int s = 0; s < 30000; ++s)
    moisture.step(0.0);
  DOUBLES_EQUAL(1.4, moisture.force_ratio(), 1e-9);
}
