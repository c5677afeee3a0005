// What follows when a held muscle does not prove that it answers, or not at once.
#include <cmath>

#include <CppUTest/TestHarness.h>

#include "supervisor/proof.hpp"
#include "unit/firmware/core/support/held_muscle.hpp"
#include "unit/firmware/core/support/paper_proof.hpp"

using namespace supercoil;
using test::HeldMuscle;
using test::paper_proof;
using test::paper_safe_W;

TEST_GROUP(ProofStages){};

TEST(ProofStages, UndecidedInTimeGivesTheSafePowerUntilAResponse) {
  HeldMuscle muscle(paper_proof());
  // Too much motion for a dead muscle, too little to exclude a dead sensor.
  muscle.swing_m = 60e-6;
  muscle.run(60.0);
  CHECK_FALSE(muscle.unanswered);
  DOUBLES_EQUAL(paper_safe_W(), muscle.min_W, 1e-9);
  muscle.swing_m = 0.0;
  muscle.run(0.5);
  muscle.demanded_W = 0.5;
  muscle.run(5.0);
  DOUBLES_EQUAL(4.5, muscle.proof.max_W(), 1e-9);
}

TEST(ProofStages, StayOverdueWhileMorePowerActsThanIsAllowed) {
  HeldMuscle muscle(paper_proof());
  muscle.swing_m = 60e-6;
  muscle.obeys = false;
  muscle.run(10.0);
  muscle.off_sensor = true;
  muscle.run(20.0);
  CHECK_FALSE(muscle.unanswered);
  DOUBLES_EQUAL(paper_safe_W(), muscle.proof.max_W(), 1e-9);
}

// The plan has no amplitude then, and the dither would not be started either.
TEST(ProofStages, NoDitherIsAddedThatIsNeverDecided) {
  ProofSettings noisy = paper_proof();
  noisy.position_noise_rms_m = 200e-6;
  noisy.derate_from_C = 170.0;  // so that the safe power passes the limit in time
  HeldMuscle muscle(noisy);
  muscle.obeys = false;
  muscle.run(20.0);
  LONGS_EQUAL(0, muscle.dither_ticks);
}

TEST(ProofStages, AMuscleAtItsLimitGetsTheSafePowerAtOnce) {
  HeldMuscle muscle(paper_proof());
  muscle.run(5.0);
  DOUBLES_EQUAL(4.5, muscle.proof.max_W(), 1e-9);
  muscle.hotter_K = 500.0;  // hotter than full power can make it
  muscle.run(0.05);
  DOUBLES_EQUAL(paper_safe_W(), muscle.proof.max_W(), 1e-9);
}

TEST(ProofStages, InWarmAirAMuscleReachesItsLimitSooner) {
  constexpr double hotter_K = 55.0, warmer_K = 30.0;  // each alone leaves a second
  ProofPlan plan = plan_proof(paper_proof(), {}, 1000.0);
  plan.adjust_for_air(paper_proof(), warmer_K);
  HeldMuscle muscle(paper_proof());
  muscle.run(5.0);
  muscle.hotter_K = hotter_K;
  muscle.run(0.05);
  DOUBLES_EQUAL(4.5, muscle.proof.max_W(), 1e-9);
  muscle.warmer_air_K = warmer_K;
  muscle.run(0.05);
  DOUBLES_EQUAL(plan.safe_W, muscle.proof.max_W(), 1e-9);
}

TEST(ProofStages, PowerIsRemovedAfterThreeQuartersOfTheTimeToTheLimit) {
  const ProofSettings s = paper_proof();
  const double worst_W_per_K = 0.25 * s.thermal.bounds.min_transfer_W_per_K;
  const double full_K = 4.5 * 1.05 / worst_W_per_K;
  const double hottest_K = 3.0 * 1.05 / s.thermal.bounds.min_transfer_W_per_K;
  const double limit_K = s.trip_C - s.thermal.air.warmest_C;
  const double to_limit_s = s.thermal.bounds.min_mass_J_per_K / worst_W_per_K *
                            std::log((full_K - hottest_K) / (full_K - limit_K));
  HeldMuscle muscle(s);
  muscle.run(30.0);
  muscle.swing_m = 60e-6;
  double undecided_s = 0.0;
  for (; undecided_s < 30.0 && muscle.proof.max_W() > 4.0; undecided_s += 0.01) {
    muscle.run(0.01);
    if (muscle.proof.answered()) undecided_s = 0.0;
  }
  DOUBLES_EQUAL(0.75 * to_limit_s, undecided_s, 0.1);
}

TEST(ProofStages, ADitherHasHeadroomAtMaxPower) {
  HeldMuscle muscle(paper_proof());
  muscle.demanded_W = 4.5;
  muscle.run(60.0);
  CHECK_FALSE(muscle.unanswered);
  CHECK_COMPARE(muscle.dither_ticks, >, 100);
  CHECK_COMPARE(muscle.peak_W, <=, 4.5);
}

TEST(ProofStages, ARemovalOfPowerWithLittleMotionEndsInTime) {
  ProofSettings far = paper_proof();
  far.obvious_m = 0.1;  // farther than the muscle ever moves
  for (const bool contact : {false, true}) {
    HeldMuscle muscle(far);
    muscle.run(20.0);
    muscle.off_sensor = !contact;
    muscle.play_m = contact ? 200e-6 : 0.0;
    muscle.run(10.0);
    LONGS_EQUAL(!contact, muscle.unanswered);
    DOUBLES_EQUAL(0.0, muscle.min_W, 0.0);
    DOUBLES_EQUAL(contact ? 4.5 : 0.0, muscle.proof.max_W(), 1e-9);
  }
}

TEST(ProofStages, NoResponseIsNotAFaultWhereFrictionAbsorbsTheDither) {
  HeldMuscle muscle(paper_proof());
  muscle.play_m = 200e-6;
  muscle.run(60.0);
  muscle.off_sensor = true;
  for (const double demanded_W : {0.2, 1.0, 0.2, 1.0}) {
    muscle.demanded_W = demanded_W;
    muscle.run(2.0);
    DOUBLES_EQUAL(paper_safe_W(), muscle.proof.max_W(), 1e-9);
  }
  CHECK_FALSE(muscle.unanswered);
}

TEST(ProofStages, NoDitherIsAddedToAPowerWithoutHeadroom) {
  ProofSettings far = paper_proof();
  far.obvious_m = 0.1;  // farther than the muscle ever moves: nothing is decided for 3 s
  HeldMuscle muscle(far);
  muscle.run(10.0);
  muscle.off_sensor = true;
  muscle.hotter_K = 500.0;  // overdue at once
  muscle.dither_ticks = 0;
  muscle.run(0.5);
  CHECK_COMPARE(muscle.dither_ticks, >, 0);
  muscle.demanded_W = 0.1;
  muscle.run(0.8);
  muscle.dither_ticks = 0;
  muscle.run(0.8);
  LONGS_EQUAL(0, muscle.dither_ticks);
  DOUBLES_EQUAL(paper_safe_W(), muscle.proof.max_W(), 1e-9);
}

TEST(ProofStages, LearningAMuscleEndsTheDither) {
  HeldMuscle muscle(paper_proof());
  while (muscle.proof.dither_W() == 0.0)
    muscle.run(0.01);
  control::PhysicalParameters other;
  other.force_per_kelvin_N_per_K *= 0.5;
  muscle.proof.learn(other, 1.0);
  DOUBLES_EQUAL(0.0, muscle.proof.dither_W(), 0.0);
}

TEST(ProofStages, WhereFrictionAbsorbsTheDitherMotionIsProofWhileItLasts) {
  HeldMuscle muscle(paper_proof());
  muscle.play_m = 200e-6;
  const auto run_sine = [&](double time_s) {
    for (int i = 0; i < std::lround(time_s * 100.0); ++i) {
      muscle.demanded_W = 2.0 + std::sin(0.01 * i);
      muscle.run(0.01);
    }
  };
  muscle.run(14.0);  // at rest: a dither, and no power until it has moved
  DOUBLES_EQUAL(0.0, muscle.min_W, 0.0);
  muscle.min_W = 1e3;
  run_sine(60.0);
  DOUBLES_EQUAL(4.5, muscle.min_W, 1e-9);
  muscle.run(30.0);
  DOUBLES_EQUAL(paper_safe_W(), muscle.min_W, 1e-9);
  run_sine(10.0);
  DOUBLES_EQUAL(paper_safe_W(), muscle.proof.max_W(), 1e-9);
  CHECK_FALSE(muscle.unanswered);
}

TEST(ProofStages, AMuscleThatMovesAndLosesContactGetsTheSafePowerInTime) {
  HeldMuscle muscle(paper_proof());
  muscle.play_m = 200e-6;
  muscle.run(14.0);
  DOUBLES_EQUAL(4.5, muscle.proof.max_W(), 1e-9);
  muscle.off_sensor = true;
  muscle.demanded_W = 4.5;
  muscle.hotter_K = 500.0;
  muscle.run(0.05);
  DOUBLES_EQUAL(paper_safe_W(), muscle.proof.max_W(), 1e-9);
}

// Play hides the start of the fall; at the safe power there is time to wait for the rest of it.
TEST(ProofStages, NoResponseAtTheSafePowerIsJudgedOnceTheMuscleMustHaveMoved) {
  HeldMuscle muscle(paper_proof());
  muscle.play_m = 300e-6;
  muscle.run(9.0);
  muscle.hotter_K = 500.0;  // overdue at once
  muscle.run(0.05);
  muscle.hotter_K = 0.0;
  DOUBLES_EQUAL(paper_safe_W(), muscle.proof.max_W(), 1e-9);
  muscle.run(3.0);
  DOUBLES_EQUAL(paper_safe_W(), muscle.min_W, 1e-9);
  DOUBLES_EQUAL(4.5, muscle.proof.max_W(), 1e-9);
  CHECK_FALSE(muscle.unanswered);
}

// The muscle answered the removal of power: from then on there is time again.
TEST(ProofStages, AMuscleThatRespondedGetsTimeAgain) {
  HeldMuscle muscle(paper_proof());
  muscle.play_m = 200e-6;
  for (int i = 0; i < 3000 && muscle.proof.max_W() > 0.0; ++i)
    muscle.run(0.01);
  muscle.hotter_K = 500.0;
  muscle.run(0.05);
  muscle.hotter_K = 0.0;
  for (int i = 0; i < 300 && muscle.proof.max_W() == 0.0; ++i)
    muscle.run(0.01);
  muscle.run(0.3);
  DOUBLES_EQUAL(4.5, muscle.proof.max_W(), 1e-9);
}

TEST(ProofStages, ADeadMuscleIsDetectedAtTheSafePowerToo) {
  HeldMuscle muscle(paper_proof());
  muscle.run(9.0);
  muscle.off_sensor = true;
  muscle.hotter_K = 500.0;  // overdue at once
  muscle.run(0.05);
  muscle.hotter_K = 0.0;
  DOUBLES_EQUAL(paper_safe_W(), muscle.proof.max_W(), 1e-9);
  muscle.run(10.0);
  CHECK(muscle.unanswered);
}

TEST(ProofStages, ARemovalOfPowerThatALoadHidesEndsAtTheSafePower) {
  ProofSettings far = paper_proof();
  far.obvious_m = 0.1;  // farther than the muscle ever moves
  HeldMuscle muscle(far);
  muscle.run(20.0);
  muscle.off_sensor = true;
  for (int i = 0; i < 1000 && muscle.proof.max_W() > 0.0; ++i)
    muscle.run(0.01);
  DOUBLES_EQUAL(0.0, muscle.proof.max_W(), 0.0);
  muscle.swing_m = 5e-3;
  muscle.run(3.5);
  CHECK_FALSE(muscle.unanswered);
  DOUBLES_EQUAL(paper_safe_W(), muscle.proof.max_W(), 1e-9);
}

TEST(ProofStages, WithoutAPositionNothingIsJudged) {
  HeldMuscle muscle(paper_proof());
  muscle.run(20.0);
  muscle.present = false;
  muscle.off_sensor = true;
  muscle.run(20.0);
  CHECK_FALSE(muscle.unanswered);
  muscle.present = true;
  muscle.moved_m = 0.01;  // the new position after the gap is not motion
  muscle.run(2.5);
  CHECK(muscle.unanswered);
}

TEST(ProofStages, RestartWithALearnedMuscle) {
  HeldMuscle muscle(paper_proof(), false);
  muscle.run(20.0);
  CHECK(std::isinf(muscle.proof.max_W()));
  muscle.proof.learn({}, 0.5);
  DOUBLES_EQUAL(0.5, muscle.proof.settings().response_ratio, 0.0);
  DOUBLES_EQUAL(4.5, muscle.proof.max_W(), 1e-9);
  muscle.off_sensor = true;
  muscle.run(20.0);
  CHECK(muscle.unanswered);
}

TEST(ProofStages, ARecalibrationIsNotMotion) {
  for (const bool reported : {false, true}) {
    HeldMuscle muscle(paper_proof());
    muscle.run(20.0);
    muscle.off_sensor = true;
    muscle.run(0.304);  // within a step, whose positions have different calibrations
    muscle.moved_m = 0.01;
    if (reported) muscle.proof.recalibrated();
    muscle.run(2.5);
    LONGS_EQUAL(reported, muscle.unanswered);
  }
}

TEST(ProofStages, AMotionHasAMomentToBecomeProofBeforeADither) {
  HeldMuscle muscle(paper_proof());
  muscle.off_sensor = true;  // so that only a dither could be answered
  muscle.hotter_K = 115.0;   // half a second from the limit: a dither is due at once
  muscle.run(0.19);
  LONGS_EQUAL(0, muscle.dither_ticks);
  muscle.run(0.1);
  CHECK_COMPARE(muscle.dither_ticks, >, 0);
}

// The new position at that moment is not motion and proves nothing.
TEST(ProofStages, ARelearnedMuscleHasNotRespondedYet) {
  const auto dither_begins = [](bool learned) {
    HeldMuscle muscle(paper_proof());
    muscle.off_sensor = true;
    muscle.moved_m = 0.008;
    int steps = 0;
    for (; muscle.dither_ticks == 0 && steps < 500; ++steps) {
      if (learned && steps == 60) muscle.proof.learn({}, 1.0);
      muscle.run(0.01);
    }
    return steps;
  };
  CHECK_COMPARE(dither_begins(false), >, 70);
  LONGS_EQUAL(dither_begins(false), dither_begins(true));
}

// The load moves too much for full power to show, but too slowly to hide the answer to a dither.
TEST(ProofStages, ASlowLoadDoesNotHideTheResponseToADither) {
  HeldMuscle muscle(paper_proof());
  muscle.run(20.0);
  muscle.min_W = 1e3;
  for (int i = 0; i < 1000; ++i) {
    muscle.moved_m += 2e-6;  // 200 um/s
    muscle.run(0.01);
  }
  CHECK_FALSE(muscle.unanswered);
  DOUBLES_EQUAL(4.5, muscle.min_W, 1e-9);
}

TEST(ProofStages, ARecalibrationDoesNotSpoilTheResponseToADither) {
  HeldMuscle muscle(paper_proof());
  muscle.run(20.0);
  muscle.min_W = 1e3;
  int dithered = 0;
  for (int i = 0; i < 1000; ++i) {
    muscle.moved_m += 2e-6;
    if (muscle.proof.dither_W() != 0.0 && ++dithered == 10) {
      muscle.moved_m += 0.01;
      muscle.proof.recalibrated();
    }
    muscle.run(0.01);
  }
  CHECK_COMPARE(dithered, >, 10);
  CHECK_FALSE(muscle.unanswered);
  DOUBLES_EQUAL(4.5, muscle.min_W, 1e-9);
}
