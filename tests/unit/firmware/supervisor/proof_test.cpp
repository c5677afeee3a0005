// A muscle that is held at a power, hot and still: does it have to prove that it answers?
#include "supervisor/proof.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <CppUTest/TestHarness.h>

#include "unit/firmware/support/paper_proof.hpp"

using namespace supercoil;
using test::paper_proof;

namespace {

constexpr double proof_tick_s = 1e-3;

/// The paper's muscle in open loop, its sensor and what keeps the one from the other.
class Held {
 public:
  explicit Held(const ProofSettings& settings, bool known = true)
      : proof(settings, {}, known, 1.0 / proof_tick_s),
        heat_(settings.thermal.bounds, proof_tick_s) {}

  /// Until a fault, for at most so long.
  void run(double time_s) {
    const double end_s = time_s_ + time_s;
    while (time_s_ + 0.5 * proof_tick_s < end_s && !unanswered)
      tick();
  }

  double wanted_W = 3.0;
  bool off_sensor = false;
  double play_m = 0.0;  ///< friction: the sensor's end follows when it is drawn by so much
  double warmer_air_K = 0.0;
  double swing_m = 0.0;  ///< of a load that swings at 1 Hz

  Proof proof;
  bool unanswered = false;
  long dither_ticks = 0;
  double lowest_W = 1e3;  ///< that was allowed

 private:
  void tick() {
    time_s_ += proof_tick_s;
    const double muscle_m = muscle_.step(power_W_);
    if (!off_sensor) end_m_ = std::clamp(end_m_, muscle_m - play_m, muscle_m + play_m);
    heat_.step(1.05 * power_W_);
    const double swing = swing_m * std::sin(6.28 * time_s_);
    const double position_m = end_m_ + swing + noise_(random_);
    proof.step({power_W_, dither_W_, 1, true, position_m, heat_.highest_K(), true, warmer_air_K});
    unanswered = unanswered || proof.unanswered();
    const double asked_W = proof.added_to(wanted_W);
    power_W_ = std::min(asked_W, proof.max_W());
    dither_W_ = power_W_ < asked_W ? 0.0 : proof.dither_W();
    dither_ticks += dither_W_ != 0.0 ? 1 : 0;
    lowest_W = std::min(lowest_W, proof.max_W());
  }

  ExpectedMotion muscle_{{}, proof_tick_s};
  control::IntervalObserver heat_;
  std::mt19937_64 random_{1};
  std::normal_distribution<double> noise_{0.0, 10e-6};
  double time_s_ = 0.0;
  double end_m_ = 0.0;
  double power_W_ = 0.0;
  double dither_W_ = 0.0;
};

}  // namespace

TEST_GROUP(Proof){};

TEST(Proof, OfALivingMuscleIsFoundAgainAndAgain) {
  Held muscle(paper_proof());
  muscle.run(600.0);
  CHECK_FALSE(muscle.unanswered);
  CHECK_COMPARE(muscle.dither_ticks, >, 1000);
  DOUBLES_EQUAL(4.5, muscle.lowest_W, 1e-9);
}

TEST(Proof, IsMissedWithinSecondsOfALostContact) {
  for (const double moment_s : {20.0, 20.3, 20.6, 20.9, 21.2}) {
    Held muscle(paper_proof());
    muscle.run(moment_s);
    muscle.off_sensor = true;
    muscle.run(3.0);
    CHECK(muscle.unanswered);
    DOUBLES_EQUAL(0.0, muscle.lowest_W, 1e-9);
    const detectors::Margin margin = muscle.proof.margin();
    CHECK_COMPARE(margin.measured, <, margin.limit);
  }
}

TEST(Proof, IsNoFaultWhereFrictionSwallowsADither) {
  Held muscle(paper_proof());
  muscle.play_m = 200e-6;
  muscle.run(60.0);
  CHECK_FALSE(muscle.unanswered);
  DOUBLES_EQUAL(plan_proof(paper_proof(), {}, 1000.0).safe_W, muscle.proof.max_W(), 1e-9);
}

TEST(Proof, IsNoFaultWhileALoadSwings) {
  Held muscle(paper_proof());
  muscle.swing_m = 300e-6;
  muscle.run(60.0);
  CHECK_FALSE(muscle.unanswered);
}

TEST(Proof, IsNotAskedForAtThePowerThatIsSafeAnyway) {
  Held muscle(paper_proof());
  muscle.wanted_W = 1.1;
  muscle.run(60.0);
  LONGS_EQUAL(0, muscle.dither_ticks);
}

TEST(Proof, AllowsWhatItCanProveWithPowerThatIsKnownBetterOrWorse) {
  ProofSettings uncompared = paper_proof();
  uncompared.max_power_ratio = 3.0;
  Held muscle(uncompared);
  muscle.run(30.0);
  const double wide_W = muscle.proof.max_W();
  DOUBLES_EQUAL(plan_proof(uncompared, {}, 1000.0).provable_W, wide_W, 1e-9);
  CHECK_COMPARE(wide_W, <, 3.0);
  muscle.proof.plan(1.05, {});
  DOUBLES_EQUAL(4.5, muscle.proof.max_W(), 1e-9);
  muscle.run(30.0);
  CHECK_FALSE(muscle.unanswered);
  muscle.proof.plan(3.0, {});
  DOUBLES_EQUAL(wide_W, muscle.proof.max_W(), 1e-9);
}

TEST(Proof, IsNotAskedOfAMuscleThatIsOnlyBelievedNorWhereItIsSwitchedOff) {
  ProofSettings off = paper_proof();
  off.wanted = false;
  for (const bool known : {false, true}) {
    Held muscle(known ? off : paper_proof(), known);
    muscle.run(20.0);
    muscle.off_sensor = true;
    muscle.run(20.0);
    LONGS_EQUAL(0, muscle.dither_ticks);
    CHECK_FALSE(muscle.unanswered);
    CHECK(std::isinf(muscle.proof.max_W()));
  }
}

TEST(Proof, IsGivenThePowerThatIsSafeInAirThatIsWarmerThanConfigured) {
  const ProofPlan plan = plan_proof(paper_proof(), {}, 1000.0);
  const double left_K = paper_proof().derate_from_C - paper_proof().thermal.air.warmest_C;
  Held muscle(paper_proof());
  muscle.play_m = 200e-6;  // so that nothing can be proven
  muscle.warmer_air_K = 0.5 * left_K;
  muscle.run(60.0);
  DOUBLES_EQUAL(0.5 * plan.safe_W, muscle.proof.max_W(), 1e-9);
  muscle.warmer_air_K = 2.0 * left_K;
  muscle.run(1.0);
  DOUBLES_EQUAL(0.0, muscle.proof.max_W(), 0.0);
  muscle.warmer_air_K = 0.0;
  muscle.run(1.0);
  DOUBLES_EQUAL(plan.safe_W, muscle.proof.max_W(), 0.0);
}

TEST(Proof, ProvesLessInAirThatIsWarmerThanConfigured) {
  ProofSettings strong = paper_proof();
  strong.max_W = 11.0;
  const double limit_K = strong.trip_C - strong.thermal.air.warmest_C;
  ProofPlan plan = plan_proof(strong, {}, 1000.0);
  const double provable_W = plan.provable_W;
  CHECK_COMPARE(provable_W, <, strong.max_W);
  plan.for_air(strong, 0.25 * limit_K);
  DOUBLES_EQUAL(0.75 * provable_W, plan.provable_W, 1e-9);
  plan.for_air(strong, 2.0 * limit_K);
  DOUBLES_EQUAL(0.0, plan.provable_W, 0.0);

  Held muscle(strong);
  muscle.warmer_air_K = 0.25 * limit_K;
  muscle.run(1.0);
  DOUBLES_EQUAL(0.75 * provable_W, muscle.proof.max_W(), 1e-9);
  muscle.proof.learn({}, 1.0);
  DOUBLES_EQUAL(0.75 * provable_W, muscle.proof.max_W(), 1e-9);
}
