// A dither that is small, decided quickly, and leaves nothing behind.
#include <algorithm>
#include <cmath>

#include <CppUTest/TestHarness.h>

#include "unit/firmware/core/support/paper_proof.hpp"

using namespace supercoil;
using test::paper_proof;
using test::slow_muscle;
using test::slow_proof;

namespace {

constexpr double dither_step_s = 0.01;

double peak_response_m(const Dither& dither, double response_ratio = 1.0) {
  ExpectedMotion motion({}, dither_step_s, response_ratio);
  double peak_m = 0.0;
  for (int i = 0; i < 300; ++i)
    peak_m = std::max(peak_m, std::abs(motion.step(dither.amplitude_W * dither.sign(i))));
  return peak_m;
}

}  // namespace

TEST_GROUP(Dither){};

TEST(Dither, MovesTheMuscleAtMost20MicrometresAndIsDecidedInHalfASecond) {
  const ProofPlan plan = plan_proof(paper_proof(), {}, 1000.0);
  CHECK_COMPARE(peak_response_m(plan.dither), <=, 20.001e-6);
  CHECK_COMPARE(plan.dither.decided_s, <, 0.5);
  DOUBLES_EQUAL(4.5, plan.provable_W, 1e-9);
}

TEST(Dither, OfAWholePeriodAddsNoHeat) {
  const ProofPlan plan = plan_proof(paper_proof(), {}, 1000.0);
  double sum = 0.0;
  for (int i = 0; i < 2 * plan.dither.half_steps; ++i)
    sum += plan.dither.sign(i);
  DOUBLES_EQUAL(0.0, sum, 0.0);
}

TEST(Dither, IsNotNeededBelowThePowerSafeAtAQuarterOfTheMinCooling) {
  // (130 - 25) K times 0.25 * 0.045 W/K; the true power may be 5 % more than measured.
  DOUBLES_EQUAL(105.0 * 0.25 * 0.045 / 1.05, plan_proof(paper_proof(), {}, 1000.0).safe_W, 1e-9);
}

TEST(Dither, IsDecidedInTimeUpToTheProvablePower) {
  ProofSettings uncompared = paper_proof();
  uncompared.max_power_ratio = 1.94;
  uncompared.position_noise_rms_m = 20e-6;
  const ProofPlan plan = plan_proof(uncompared, {}, 1000.0);
  CHECK_COMPARE(plan.safe_W, <, plan.provable_W);
  CHECK_COMPARE(plan.provable_W, <, uncompared.max_W);
  // From the hot end at this power, with a quarter of the minimum cooling and no more power.
  const auto left_s = [](double power_W) {
    const double transfer_W_per_K = 0.25 * 0.045;
    const double full_K = 1.94 * power_W / transfer_W_per_K;
    return 0.13 / transfer_W_per_K * std::log(0.75 * full_K / (full_K - 135.0));
  };
  // A closed loop needs 1.3 times the open-loop decision time, within three quarters of the time.
  const double needed_s = plan.dither.decided_s * 1.3 / 0.75;
  DOUBLES_EQUAL(needed_s, left_s(plan.provable_W), 1e-6);
  CHECK_COMPARE(left_s(1.01 * plan.provable_W), <, needed_s);
}

TEST(Dither, IsTheSlowestAndGentlestThatIsDecidedInTime) {
  const ProofPlan hurried = plan_proof(paper_proof(), {}, 1000.0);
  ProofSettings patient = paper_proof();
  patient.trip_C = 300.0;
  const ProofPlan plan = plan_proof(patient, {}, 1000.0);
  CHECK_COMPARE(plan.dither.decided_s, >, hurried.dither.decided_s);
  CHECK_COMPARE(plan.dither.amplitude_W, <, hurried.dither.amplitude_W);
  CHECK_COMPARE(plan.dither.half_steps, >, hurried.dither.half_steps);
}

TEST(Dither, IsNotNeededWhereMaxPowerCannotExceedTheLimit) {
  ProofSettings weak = paper_proof();
  weak.position_noise_rms_m = 200e-6;
  weak.max_W = 1.4;  // 1.05 times that over 0.25 * 0.045 W/K is 131 K; 135 K are allowed
  const ProofPlan plan = plan_proof(weak, {}, 1000.0);
  CHECK(std::isinf(plan.dither.decided_s));
  CHECK_COMPARE(plan.safe_W, <, weak.max_W);
  DOUBLES_EQUAL(weak.max_W, plan.provable_W, 1e-9);
}

TEST(Dither, HiddenByNoiseLimitsTheMuscleToTheSafePower) {
  ProofSettings noisy = paper_proof();
  noisy.position_noise_rms_m = 200e-6;
  const ProofPlan plan = plan_proof(noisy, {}, 1000.0);
  DOUBLES_EQUAL(plan.safe_W, plan.provable_W, 1e-9);
}

TEST(Dither, AmplitudeScalesInverselyWithTheMeasuredResponse) {
  const ProofPlan whole = plan_proof(paper_proof(), {}, 1000.0);
  for (const double ratio : {0.4, 2.0}) {
    ProofSettings measured = paper_proof();
    measured.response_ratio = ratio;
    const ProofPlan plan = plan_proof(measured, {}, 1000.0);
    DOUBLES_EQUAL(whole.dither.amplitude_W / ratio, plan.dither.amplitude_W, 1e-9);
    DOUBLES_EQUAL(20e-6, peak_response_m(plan.dither, ratio), 1e-9);
    DOUBLES_EQUAL(whole.dither.decided_s, plan.dither.decided_s, 1e-9);
    DOUBLES_EQUAL(4.5, plan.provable_W, 1e-9);
  }
}

TEST(Dither, AbsorbedByFrictionLimitsTheMuscleToTheSafePower) {
  ProofSettings stuck = paper_proof();
  stuck.response_ratio = 0.01;
  const ProofPlan plan = plan_proof(stuck, {}, 1000.0);
  CHECK(std::isinf(plan.dither.decided_s));
  DOUBLES_EQUAL(plan.safe_W, plan.provable_W, 1e-9);
}

TEST(Dither, HasTheLongestHalfPeriodWhenTimeAllows) {
  ProofSettings patient = paper_proof();
  patient.trip_C = 400.0;
  patient.position_noise_rms_m = 3e-6;
  const ProofPlan plan = plan_proof(patient, {}, 1000.0);
  LONGS_EQUAL(std::lround(1.2 / dither_step_s), plan.dither.half_steps);
}

TEST(Dither, IsSlowForASlowMuscle) {
  // A tenth of max_W takes seconds to move it by 20 um; at 2.8 W the limit is 5.6 s away.
  ProofSettings slow = slow_proof();
  slow.max_power_ratio = 1.94;
  const ProofPlan plan = plan_proof(slow, slow_muscle(), 1000.0);
  CHECK_COMPARE(plan.dither.half_steps * dither_step_s, >, 1.2);
  DOUBLES_EQUAL(4.0 * 1.2, plan.dither.corner_rad_per_s * plan.dither.half_steps * dither_step_s,
                1e-9);
  CHECK_COMPARE(plan.dither.decided_s, <, 2.5 * plan.dither.half_steps * dither_step_s);
  CHECK_COMPARE(plan.safe_W, <, 0.4 * plan.provable_W);
}
