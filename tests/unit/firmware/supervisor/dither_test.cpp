// A dither that is small, soon decided, and leaves nothing behind.
#include <algorithm>
#include <cmath>

#include <CppUTest/TestHarness.h>

#include "supervisor/proof.hpp"

using namespace supercoil;

namespace {

constexpr double dither_step_s = 0.01;

/// The paper's muscle under the default limits.
ProofSettings usual() {
  ProofSettings s;
  s.max_power_ratio = 1.05;
  s.max_W = 4.5;
  s.derate_from_C = 130.0;
  s.trip_C = 160.0;
  s.position_noise_rms_m = 10e-6;
  s.count_m = 0.6e-6;
  return s;
}

double greatest_answer_m(const Dither& dither) {
  ExpectedMotion motion({}, dither_step_s);
  double greatest_m = 0.0;
  for (int i = 0; i < 300; ++i)
    greatest_m = std::max(greatest_m, std::abs(motion.step(dither.amplitude_W * dither.sign(i))));
  return greatest_m;
}

}  // namespace

TEST_GROUP(Dither){};

TEST(Dither, MovesTheMuscleBy20MicrometresAtMostAndIsDecidedInHalfASecond) {
  const ProofPlan plan = plan_proof(usual(), {}, 1000.0);
  CHECK_COMPARE(greatest_answer_m(plan.dither), <=, 20.001e-6);
  CHECK_COMPARE(plan.dither.decided_s, <, 0.5);
  DOUBLES_EQUAL(4.5, plan.provable_W, 1e-9);
}

TEST(Dither, OfAWholePeriodAddsNoHeat) {
  const ProofPlan plan = plan_proof(usual(), {}, 1000.0);
  double sum = 0.0;
  for (int i = 0; i < 2 * plan.dither.half_steps; ++i)
    sum += plan.dither.sign(i);
  DOUBLES_EQUAL(0.0, sum, 0.0);
}

TEST(Dither, IsNotNeededBelowThePowerThatAQuarterOfTheLeastCoolingBears) {
  // (130 - 25) K of 0.25 * 0.045 W/K, of which 5 % more may be given than is told.
  DOUBLES_EQUAL(105.0 * 0.25 * 0.045 / 1.05, plan_proof(usual(), {}, 1000.0).safe_W, 1e-9);
}

TEST(Dither, ThatTheNoiseHidesHoldsTheMuscleToTheSafePower) {
  ProofSettings noisy = usual();
  noisy.position_noise_rms_m = 200e-6;
  const ProofPlan plan = plan_proof(noisy, {}, 1000.0);
  DOUBLES_EQUAL(plan.safe_W, plan.provable_W, 1e-9);
}
