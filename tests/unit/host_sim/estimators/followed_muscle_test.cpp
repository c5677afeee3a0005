// Least squares on muscles that differ from its model: what it takes for a change, and what it then
// forgets. For many muscles see tests/unit/control/muscles_study.cpp.
#include "unit/host_sim/estimators/support/followed_muscle.hpp"

#include <CppUTest/TestHarness.h>

using namespace supercoil;
using host_sim::MusclePreset;
using test::Course;
using test::followed;
using test::FollowedMuscle;

namespace {

constexpr double period_s = 25.132741;  ///< period of the sine

/// The latest detection over all phases of the sine.
double slowest_s(FollowedMuscle muscle, int phases) {
  double slowest = 0.0;
  for (int i = 0; i < phases; ++i) {
    muscle.change_at_s = 100.0 + period_s * i / phases;
    const double after_s = test::found_after_s(muscle);
    if (after_s < 0.0) return INFINITY;
    slowest = std::fmax(slowest, after_s);
  }
  return slowest;
}

std::int64_t changes_in(FollowedMuscle muscle, Course motion, double duration_s) {
  std::int64_t changes = 0;
  muscle.motion = motion;
  muscle.run(duration_s, [&](const FollowedMuscle::Tick& tick) {
    changes = tick.estimator.changes();
    return true;
  });
  return changes;
}

}  // namespace

TEST_GROUP(Changes){};

TEST(Changes, AreNotReportedForAModelError) {
  for (const MusclePreset preset :
       {MusclePreset::paper, MusclePreset::real, MusclePreset::real_hard, MusclePreset::b}) {
    for (const Course motion : {Course::sine, Course::steps, Course::random_steps})
      LONGS_EQUAL(0, changes_in(followed(preset), motion, 400.0));
  }
}

TEST(Changes, ASofterMuscleIsDetectedWithinHalfASecondOrOneOnRealMuscles) {
  FollowedMuscle muscle = followed(MusclePreset::paper);
  muscle.stiffness_ratio = 0.75;
  CHECK(slowest_s(muscle, 4) <= 0.5);
  for (const MusclePreset preset : {MusclePreset::real, MusclePreset::real_hard}) {
    FollowedMuscle real = followed(preset);
    real.stiffness_ratio = 0.75;
    CHECK(slowest_s(real, 4) <= 1.0);
  }
}

TEST(Changes, ALoadIsDetectedWithinASecond) {
  FollowedMuscle muscle = followed(MusclePreset::paper);
  muscle.load_N = 0.1;
  CHECK(slowest_s(muscle, 4) <= 1.0);
}

TEST(Changes, ALoadDoesNotChangeTheta2AndTheta3) {
  FollowedMuscle muscle = followed(MusclePreset::paper);
  muscle.load_N = 0.1;
  for (const Course motion : {Course::sine, Course::steps, Course::random_steps}) {
    muscle.motion = motion;
    // With the load, 4.5 W hold 19 mm.
    muscle.max_m = motion == Course::sine ? 0.020 : 0.015;
    for (int i = 0; i < 4; ++i) {
      muscle.change_at_s = 100.0 + 7.0 * i;
      double off = 0.0;
      muscle.run(muscle.change_at_s + 40.0, [&](const FollowedMuscle::Tick& tick) {
        if (tick.time_s < muscle.change_at_s) return true;
        const auto& theta = tick.estimator.parameters();
        off = std::fmax(off, std::fmax(std::abs(theta[1] - 1.0), std::abs(theta[2] - 1.0)));
        return true;
      });
      CHECK_COMPARE(off, <, 0.05);
    }
  }
}

TEST(Changes, ASofterMusclesThetaIsKnownTwoSecondsLater) {
  FollowedMuscle muscle = followed(MusclePreset::paper);
  muscle.stiffness_ratio = 0.75;
  for (const Course motion : {Course::sine, Course::steps, Course::random_steps}) {
    muscle.motion = motion;
    for (int i = 0; i < 4; ++i) {
      muscle.change_at_s = 100.0 + 7.0 * i;
      muscle.run(muscle.change_at_s + 20.0, [&](const FollowedMuscle::Tick& tick) {
        if (tick.time_s < muscle.change_at_s + 2.0) return true;
        const auto& theta = tick.estimator.parameters();
        CHECK_COMPARE(std::abs(theta[1] - 1.0), <, 0.05);
        CHECK_COMPARE(std::abs(theta[2] / 0.75 - 1.0), <, 0.05);
        CHECK_COMPARE(std::abs(theta[3] / 0.75 - 1.0), <, 0.05);
        return true;
      });
    }
  }
}

TEST(Changes, DetectionTimesScaleWithTheMuscle) {
  FollowedMuscle small;
  small.parameters.thermal_mass_J_per_K = 0.015;
  small.parameters.heat_transfer_W_per_K *= 0.015 / 0.162;
  small.max_W *= 0.015 / 0.162;
  small.stiffness_ratio = 0.75;
  CHECK(slowest_s(small, 2) <= 0.5);
  FollowedMuscle stiff;
  stiff.parameters.stiffness_N_per_m = 80.0;
  stiff.min_m = 0.0005;
  stiff.max_m = 0.004;
  stiff.stiffness_ratio = 0.75;
  CHECK(slowest_s(stiff, 2) <= 0.5);
}

TEST(Changes, AnUnexcitedDirectionDoesNotDriftOrStopTheOthers) {
  // The sine of 0.25 rad/s hardly shows θ1; unmodelled effects would be attributed to it.
  FollowedMuscle muscle = followed(MusclePreset::real);
  muscle.run(900.0, [&](const FollowedMuscle::Tick& tick) {
    const auto& theta = tick.estimator.parameters();
    const auto& deviations = tick.estimator.standard_deviations();
    if (tick.time_s > 60.0) CHECK(std::abs(theta[0] - 1.0) < 0.5);
    if (tick.time_s > 60.0) CHECK(deviations[0] < 1.0);
    return true;
  });
  muscle.effects = {};
  muscle.stiffness_ratio = 0.75;
  muscle.change_at_s = 900.0;
  double off = 1.0;
  muscle.run(910.0, [&](const FollowedMuscle::Tick& tick) {
    off = std::abs(tick.estimator.parameters()[3] / 0.75 - 1.0);
    return true;
  });
  CHECK(off < 0.01);
}
