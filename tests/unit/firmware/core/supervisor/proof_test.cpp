// Whether a muscle that is held at a power, hot and still, has to prove that it answers.
#include "supervisor/proof.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>

#include "unit/firmware/core/support/held_muscle.hpp"
#include "unit/firmware/core/support/paper_proof.hpp"

using namespace supercoil;
using test::HeldMuscle;
using test::paper_proof;

TEST_GROUP(Proof){};

TEST(Proof, OfALivingMuscleIsRepeated) {
  HeldMuscle muscle(paper_proof());
  muscle.run(600.0);
  CHECK_FALSE(muscle.unanswered);
  CHECK_COMPARE(muscle.dither_ticks, >, 1000);
  DOUBLES_EQUAL(4.5, muscle.min_W, 1e-9);
}

TEST(Proof, IsMissedWithinSecondsOfALostContact) {
  for (const double moment_s : {20.0, 20.3, 20.6, 20.9, 21.2}) {
    HeldMuscle muscle(paper_proof());
    muscle.run(moment_s);
    muscle.off_sensor = true;
    muscle.run(3.0);
    CHECK(muscle.unanswered);
    DOUBLES_EQUAL(0.0, muscle.min_W, 1e-9);
    const detectors::Margin margin = muscle.proof.margin();
    CHECK_COMPARE(margin.measured, <, margin.limit);
    // Of an expected motion of at least twice the obvious one.
    const double expected_m = margin.limit / detectors::Response::silent_ratio;
    DOUBLES_EQUAL(2.0 * paper_proof().obvious_m, expected_m, 0.1 * paper_proof().obvious_m);
  }
}

TEST(Proof, IsNoFaultWhereFrictionAbsorbsTheDither) {
  HeldMuscle muscle(paper_proof());
  muscle.play_m = 200e-6;
  muscle.run(60.0);
  CHECK_FALSE(muscle.unanswered);
  DOUBLES_EQUAL(plan_proof(paper_proof(), {}, 1000.0).safe_W, muscle.proof.max_W(), 1e-9);
}

TEST(Proof, IsNoFaultWhileALoadSwings) {
  HeldMuscle muscle(paper_proof());
  muscle.swing_m = 300e-6;
  muscle.run(60.0);
  CHECK_FALSE(muscle.unanswered);
}

TEST(Proof, IsNotRequiredAtTheSafePower) {
  for (const bool off_sensor : {false, true}) {
    HeldMuscle muscle(paper_proof());
    muscle.off_sensor = off_sensor;
    muscle.demanded_W = 1.1;
    muscle.run(60.0);
    LONGS_EQUAL(0, muscle.dither_ticks);
    DOUBLES_EQUAL(4.5, muscle.min_W, 1e-9);
  }
}

TEST(Proof, AllowsLessPowerTheLessAccuratelyItIsKnown) {
  ProofSettings uncompared = paper_proof();
  uncompared.max_power_ratio = 3.0;
  HeldMuscle muscle(uncompared);
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

TEST(Proof, IsNotRequiredOfAnUnidentifiedMuscleOrWhenSwitchedOff) {
  ProofSettings off = paper_proof();
  off.enabled = false;
  for (const bool known : {false, true}) {
    HeldMuscle muscle(known ? off : paper_proof(), known);
    muscle.run(20.0);
    muscle.off_sensor = true;
    muscle.run(20.0);
    LONGS_EQUAL(0, muscle.dither_ticks);
    CHECK_FALSE(muscle.unanswered);
    CHECK(std::isinf(muscle.proof.max_W()));
  }
}

TEST(Proof, SafePowerIsLowerInAirWarmerThanConfigured) {
  const ProofPlan plan = plan_proof(paper_proof(), {}, 1000.0);
  const double left_K = paper_proof().derate_from_C - paper_proof().thermal.air.warmest_C;
  HeldMuscle muscle(paper_proof());
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

TEST(Proof, ProvablePowerIsLowerInAirWarmerThanConfigured) {
  ProofSettings strong = paper_proof();
  strong.max_W = 11.0;
  const double limit_K = strong.trip_C - strong.thermal.air.warmest_C;
  ProofPlan plan = plan_proof(strong, {}, 1000.0);
  const double provable_W = plan.provable_W;
  CHECK_COMPARE(provable_W, <, strong.max_W);
  plan.adjust_for_air(strong, 0.25 * limit_K);
  DOUBLES_EQUAL(0.75 * provable_W, plan.provable_W, 1e-9);
  plan.adjust_for_air(strong, 2.0 * limit_K);
  DOUBLES_EQUAL(0.0, plan.provable_W, 0.0);

  HeldMuscle muscle(strong);
  muscle.warmer_air_K = 0.25 * limit_K;
  muscle.run(1.0);
  DOUBLES_EQUAL(0.75 * provable_W, muscle.proof.max_W(), 1e-9);
  muscle.proof.learn({}, 1.0);
  DOUBLES_EQUAL(0.75 * provable_W, muscle.proof.max_W(), 1e-9);
  muscle.proof.plan(strong.max_power_ratio, {});
  DOUBLES_EQUAL(0.75 * provable_W, muscle.proof.max_W(), 1e-9);
}

namespace {

constexpr double limit_C = 160.0;

/// The fault is found, or the muscle is held to the safe power; it is never as hot as the limit.
void check_safe(const HeldMuscle& muscle, const ProofSettings& settings) {
  CHECK_COMPARE(muscle.hottest_C(), <, limit_C);
  const double safe_W = plan_proof(settings, {}, 1000.0).safe_W;
  CHECK(muscle.unanswered || muscle.proof.max_W() <= safe_W);
}

}  // namespace

// Neither a rest nor a moment at low power gives back time that was used without a proof.
TEST(Proof, IsNotPostponedByRestsOrMomentsOfLowPower) {
  for (const bool rests : {false, true}) {
    for (const double heated_s : {0.25, 0.5, 1.0, 2.0}) {
      HeldMuscle muscle(paper_proof());
      muscle.run(20.0);
      muscle.off_sensor = true;
      for (int i = 0; i < 60 && !muscle.unanswered; ++i) {
        muscle.heating = true;
        muscle.demanded_W = 4.0;
        muscle.run(heated_s);
        muscle.heating = !rests;
        muscle.demanded_W = 0.0;
        muscle.run(0.1 * heated_s);
      }
      check_safe(muscle, paper_proof());
    }
  }
}

// At the safe power a muscle off its sensor becomes four times as hot as is believed.
TEST(Proof, IsRequiredSoonerTheHotterTheMuscleMayBe) {
  HeldMuscle muscle(paper_proof());
  muscle.demanded_W = 1.1;
  muscle.run(20.0);
  muscle.off_sensor = true;
  muscle.run(80.0);
  DOUBLES_EQUAL(4.5, muscle.min_W, 1e-9);
  muscle.demanded_W = 4.5;
  muscle.run(10.0);
  check_safe(muscle, paper_proof());
}

TEST(Proof, IsMissedInTimeWhenTheSensorMovesAsItLosesContact) {
  ProofSettings s = paper_proof();
  s.position_noise_rms_m = 30e-6;
  s.max_power_ratio = 1.5;
  control::PhysicalParameters weak;
  weak.force_per_kelvin_N_per_K *= 0.35;
  for (int i = 0; i < 24; ++i) {
    HeldMuscle muscle(s, true, weak, static_cast<std::uint64_t>(i));
    muscle.noise_m = s.position_noise_rms_m;
    muscle.power_ratio = s.max_power_ratio;
    muscle.demanded_W = 4.5;
    muscle.run(20.0 + 0.23 * i);
    CHECK_FALSE(muscle.unanswered);
    muscle.off_sensor = true;
    muscle.moved_m = 0.001;
    muscle.run(20.0);
    CHECK(muscle.unanswered);
    CHECK_COMPARE(muscle.hottest_C(), <, limit_C);
  }
}

// Motion from any other cause does not postpone the proof beyond the time that there is.
TEST(Proof, IsRequiredOfADeadMuscleWhileALoadSwings) {
  HeldMuscle muscle(paper_proof());
  muscle.demanded_W = 4.5;
  muscle.run(20.0);
  muscle.off_sensor = true;
  muscle.swing_m = 300e-6;
  muscle.run(60.0);
  check_safe(muscle, paper_proof());
}
