// How long a muscle may be hot without proving that it answers: with rests, depending on its heat,
// in warm air, after a jump.
#include <CppUTest/TestHarness.h>

#include "supervisor/proof.hpp"
#include "unit/firmware/core/support/held_muscle.hpp"
#include "unit/firmware/core/support/paper_proof.hpp"

using namespace supercoil;
using test::HeldMuscle;
using test::paper_proof;
using test::paper_safe_W;
using test::slow_muscle;
using test::slow_proof;

TEST_GROUP(ProofTime){};

// A short rest does not give back the time that was used.
TEST(ProofTime, TheSafePowerHoldsUntilTheMuscleRespondsOrMustHaveCooled) {
  for (const bool off_sensor : {false, true}) {
    HeldMuscle muscle(paper_proof());
    muscle.play_m = 200e-6;
    muscle.run(60.0);
    muscle.off_sensor = off_sensor;
    muscle.heating = false;
    muscle.demanded_W = 0.0;
    muscle.run(2.0);
    DOUBLES_EQUAL(off_sensor ? paper_safe_W() : 4.5, muscle.proof.max_W(), 1e-9);
    muscle.run(20.0);
    DOUBLES_EQUAL(4.5, muscle.proof.max_W(), 1e-9);
  }
}

// The fall after the swing proves the muscle, once the swing is forgotten.
TEST(ProofTime, MotionAtRestIsForgottenAfterTwoSecondsToo) {
  HeldMuscle muscle(paper_proof());
  muscle.play_m = 200e-6;
  muscle.run(60.0);
  muscle.heating = false;
  muscle.demanded_W = 0.0;
  muscle.swing_m = 0.1;
  muscle.run(0.75);
  DOUBLES_EQUAL(paper_safe_W(), muscle.proof.max_W(), 1e-9);
  muscle.swing_m = 0.0;
  muscle.run(2.25);
  DOUBLES_EQUAL(4.5, muscle.proof.max_W(), 1e-9);
}

TEST(ProofTime, ARestDoesNotEndARemovalOfPowerUndecided) {
  ProofSettings far = paper_proof();
  far.obvious_m = 0.1;  // farther than the muscle ever moves
  HeldMuscle muscle(far);
  muscle.demanded_W = 4.5;
  muscle.run(20.0);
  muscle.off_sensor = true;
  for (int i = 0; i < 1000 && muscle.proof.max_W() > 0.0; ++i)
    muscle.run(0.01);
  DOUBLES_EQUAL(0.0, muscle.proof.max_W(), 0.0);
  muscle.heating = false;
  muscle.run(0.1);
  muscle.heating = true;
  muscle.run(0.1);
  DOUBLES_EQUAL(paper_safe_W(), muscle.proof.max_W(), 1e-9);
}

// After long at the safe power it may be so hot that no time is left at any higher power.
TEST(ProofTime, AMuscleThatIsHeldDownAtRestGetsItsPowerBackByADither) {
  ProofSettings near = paper_proof();
  near.derate_from_C = 155.0;
  HeldMuscle muscle(near);
  const double safe_W = plan_proof(near, {}, 1000.0).safe_W;
  muscle.demanded_W = safe_W;
  muscle.run(60.0);
  DOUBLES_EQUAL(4.5, muscle.min_W, 1e-9);
  muscle.demanded_W = 4.0;
  muscle.run(0.1);
  DOUBLES_EQUAL(safe_W, muscle.proof.max_W(), 1e-9);
  muscle.run(5.0);
  DOUBLES_EQUAL(4.5, muscle.proof.max_W(), 1e-9);
  CHECK_FALSE(muscle.unanswered);
}

// The hot end already accounts for how hot the muscle may be before it is first heated.
TEST(ProofTime, HeatFromBeforeTheFirstHeatingUsesNoTime) {
  HeldMuscle muscle(paper_proof());
  muscle.off_sensor = true;
  muscle.heating = false;
  muscle.hotter_K = 130.0;
  muscle.demanded_W = 0.0;
  muscle.run(1.0);
  muscle.hotter_K = 0.0;
  muscle.heating = true;
  muscle.demanded_W = 1.3;
  muscle.run(1.0);
  LONGS_EQUAL(0, muscle.dither_ticks);
  DOUBLES_EQUAL(4.5, muscle.min_W, 1e-9);
}

TEST(ProofTime, TheHotEndWhileHeatedIsRemembered) {
  HeldMuscle muscle(paper_proof());
  muscle.off_sensor = true;
  muscle.demanded_W = 1.3;
  muscle.run(0.3);
  muscle.hotter_K = 110.0;
  muscle.run(0.1);
  muscle.hotter_K = 0.0;
  muscle.run(0.3);
  CHECK_COMPARE(muscle.dither_ticks, >, 0);
}

TEST(ProofTime, WarmAirCountsTowardsTheHotEnd) {
  for (const double warmer_K : {0.0, 30.0}) {
    ProofPlan plan = plan_proof(paper_proof(), {}, 1000.0);
    plan.adjust_for_air(paper_proof(), warmer_K);
    HeldMuscle muscle(paper_proof());
    muscle.warmer_air_K = warmer_K;
    muscle.off_sensor = true;
    muscle.demanded_W = 0.98 * plan.safe_W;
    muscle.run(60.0);
    LONGS_EQUAL(0, muscle.dither_ticks);
    muscle.demanded_W = 4.0;
    muscle.run(0.25);
    CHECK_COMPARE(muscle.dither_ticks, >, 0);
  }
}

TEST(ProofTime, AJumpPostponesASlowDitherByAtMostTwoSeconds) {
  CHECK_COMPARE(plan_proof(slow_proof(), slow_muscle(), 1000.0).dither.decided_s, >, 3.0);
  const auto dither_after_s = [](double jump_m) {
    HeldMuscle muscle(slow_proof(), true, slow_muscle());
    muscle.demanded_W = 2.0;
    muscle.run(100.0);
    while (muscle.proof.dither_W() == 0.0)
      muscle.run(0.01);
    while (muscle.proof.dither_W() != 0.0)
      muscle.run(0.01);
    muscle.off_sensor = true;
    muscle.moved_m = jump_m;
    muscle.dither_ticks = 0;
    double time_s = 0.0;
    for (; muscle.dither_ticks == 0 && time_s < 60.0; time_s += 0.01)
      muscle.run(0.01);
    return time_s;
  };
  CHECK_COMPARE(dither_after_s(0.001) - dither_after_s(0.0), <, 2.1);
}

TEST(ProofTime, AMuscleThatMovedIsDitheredAgainAfterARest) {
  HeldMuscle muscle(paper_proof());
  muscle.play_m = 200e-6;
  muscle.run(14.0);
  DOUBLES_EQUAL(4.5, muscle.proof.max_W(), 1e-9);
  muscle.heating = false;
  muscle.run(0.1);
  muscle.heating = true;
  muscle.min_W = 1e3;
  muscle.run(14.0);
  DOUBLES_EQUAL(0.0, muscle.min_W, 0.0);
}
