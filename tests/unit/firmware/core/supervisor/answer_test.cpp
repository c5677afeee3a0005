// How often a muscle that is dead passes, and one that lives does not.
#include "supervisor/detectors/answer.hpp"

#include <cmath>
#include <random>

#include <CppUTest/TestHarness.h>

using namespace supercoil;

namespace {

constexpr double step_noise_m = 3.2e-6;  // 10 um rms at 1 kHz, averaged over 10 ms

/// The part of blocks that end so: of a muscle that answers with this ratio of what is expected, a
/// sine of 7 um rms.
double part_that_is(detectors::Answer::Result wanted, double answer_ratio, int blocks) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0.0, step_noise_m);
  int found = 0;
  for (int block = 0; block < blocks; ++block) {
    detectors::Answer answer(step_noise_m);
    auto result = detectors::Answer::Result::open;
    for (int i = 0; i < 300 && result == detectors::Answer::Result::open; ++i) {
      const double expected_m = 10e-6 * std::sin(0.1 * i + block);
      result = answer.step(expected_m, answer_ratio * expected_m + noise(random));
    }
    found += result == wanted ? 1 : 0;
  }
  return static_cast<double>(found) / blocks;
}

/// Of a normal distribution, above so many deviations.
double tail(double deviations) {
  return 0.5 * std::erfc(deviations / std::sqrt(2.0));
}

}  // namespace

TEST_GROUP(Answer){};

TEST(Answer, OfADeadMuscleIsTakenForOneInAThousandBlocksAtMost) {
  CHECK_COMPARE(part_that_is(detectors::Answer::Result::answered, 0.0, 50000), <=, 1.3e-3);
}

// 1e-9 cannot be counted: it is at most twice a normal tail at 1, 2, 3 and 4 deviations, and half
// of the model's answer is 6.2 deviations from the threshold.
TEST(Answer, OfALivingMuscleIsMissedAsANormalTailSays) {
  for (const double deviations : {1.0, 2.0, 3.0, 4.0}) {
    const double ratio =
        detectors::Answer::silent_ratio + deviations / detectors::Answer::needed_deviations;
    const double missed = part_that_is(detectors::Answer::Result::silent, ratio, 40000);
    CHECK_COMPARE(missed, <=, 2.0 * tail(deviations) + 5e-5);
  }
  const double of_half = (detectors::Answer::least_answer_ratio - detectors::Answer::silent_ratio) *
                         detectors::Answer::needed_deviations;
  CHECK_COMPARE(2.0 * tail(of_half), <=, 1e-9);
}

TEST(Answer, IsOpenWhileSomethingElseMovesThePosition) {
  detectors::Answer answer(step_noise_m);
  for (int i = 0; i < 300; ++i) {
    const auto result = answer.step(10e-6 * std::sin(0.1 * i), 200e-6 * std::sin(0.037 * i));
    CHECK(result == detectors::Answer::Result::open);
  }
}

// By itself, at a rate of its own: 0.2 of the expected motion is little, 0.45 is a muscle that
// lives.
TEST(Answer, OfAMuscleThatMovesMuchByItselfIsOpenHoweverLongItLasts) {
  for (const double moved_ratio : {0.2, 0.45}) {
    detectors::Answer answer(step_noise_m);
    auto result = detectors::Answer::Result::open;
    for (int i = 0; i < 2000 && result == detectors::Answer::Result::open; ++i) {
      const double expected_m = 1e-3 * std::sin(0.1 * i);
      result = answer.step(expected_m, moved_ratio * 1e-3 * std::sin(0.37 * i));
    }
    CHECK((result == detectors::Answer::Result::silent) == (moved_ratio < 0.3));
    CHECK(result != detectors::Answer::Result::answered);
  }
}

TEST(Answer, HasNoRatioBeforeAnythingWasExpected) {
  detectors::Answer answer(step_noise_m);
  CHECK(answer.step(0.0, 1e-3) == detectors::Answer::Result::open);
  DOUBLES_EQUAL(0.0, answer.ratio(), 0.0);
}

TEST(Answer, IgnoresADrift) {
  detectors::SlowPartRemoved fast(1.0, 0.01);
  fast.settle(0.02);
  double last_m = 0.0;
  for (int i = 0; i < 2000; ++i)
    last_m = fast.step(0.02 + 10e-6 * 0.01 * i);
  CHECK_COMPARE(std::abs(last_m), <, 1e-7);
}
