// How often a dead muscle passes, and how often a living one does not.
#include "supervisor/detectors/response.hpp"

#include <cmath>
#include <random>

#include <CppUTest/TestHarness.h>

using namespace supercoil;

namespace {

constexpr double step_noise_m = 3.2e-6;  // 10 um rms at 1 kHz, averaged over 10 ms

/// The fraction of blocks with this result, for a muscle that answers with this ratio of the
/// expected motion, a sine of 7 um rms.
double fraction_with_result(detectors::Response::Result wanted, double response_ratio, int blocks) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0.0, step_noise_m);
  int found = 0;
  for (int block = 0; block < blocks; ++block) {
    detectors::Response answer(step_noise_m);
    auto result = detectors::Response::Result::open;
    for (int i = 0; i < 300 && result == detectors::Response::Result::open; ++i) {
      const double expected_m = 10e-6 * std::sin(0.1 * i + block);
      result = answer.step(expected_m, response_ratio * expected_m + noise(random));
    }
    found += result == wanted ? 1 : 0;
  }
  return static_cast<double>(found) / blocks;
}

/// The part of a normal distribution above this many deviations.
double tail(double deviations) {
  return 0.5 * std::erfc(deviations / std::sqrt(2.0));
}

}  // namespace

TEST_GROUP(Response){};

TEST(Response, FalseResponsesOfADeadMuscleAreAtMostOneInAThousand) {
  CHECK_COMPARE(fraction_with_result(detectors::Response::Result::answered, 0.0, 50000), <=,
                1.3e-3);
}

// 1e-9 cannot be counted. The missed fraction is at most twice a normal tail at 1, 2, 3 and 4
// deviations, and half of the model's answer is 6.2 deviations from the threshold.
TEST(Response, MissRateOfALivingMuscleFollowsTheNormalTail) {
  for (const double deviations : {1.0, 2.0, 3.0, 4.0}) {
    const double ratio =
        detectors::Response::silent_ratio + deviations / detectors::Response::needed_deviations;
    const double missed = fraction_with_result(detectors::Response::Result::silent, ratio, 40000);
    CHECK_COMPARE(missed, <=, 2.0 * tail(deviations) + 5e-5);
  }
  const double of_half =
      (detectors::Response::min_response_ratio - detectors::Response::silent_ratio) *
      detectors::Response::needed_deviations;
  CHECK_COMPARE(2.0 * tail(of_half), <=, 1e-9);
}

TEST(Response, IsOpenWhileSomethingElseMovesThePosition) {
  detectors::Response answer(step_noise_m);
  for (int i = 0; i < 300; ++i) {
    const auto result = answer.step(10e-6 * std::sin(0.1 * i), 200e-6 * std::sin(0.037 * i));
    CHECK(result == detectors::Response::Result::open);
  }
}

// It moves by itself, at a rate of its own: 0.2 of the expected motion is too little, 0.45 is a
// living muscle.
TEST(Response, StaysOpenForUnrelatedMotionThatLasts) {
  for (const double moved_ratio : {0.2, 0.45}) {
    detectors::Response answer(step_noise_m);
    auto result = detectors::Response::Result::open;
    for (int i = 0; i < 2000 && result == detectors::Response::Result::open; ++i) {
      const double expected_m = 1e-3 * std::sin(0.1 * i);
      result = answer.step(expected_m, moved_ratio * 1e-3 * std::sin(0.37 * i));
    }
    CHECK((result == detectors::Response::Result::silent) == (moved_ratio < 0.3));
    CHECK(result != detectors::Response::Result::answered);
  }
}

TEST(Response, HasNoRatioBeforeAnythingWasExpected) {
  detectors::Response answer(step_noise_m);
  CHECK(answer.step(0.0, 1e-3) == detectors::Response::Result::open);
  DOUBLES_EQUAL(0.0, answer.ratio(), 0.0);
}

TEST(Response, IgnoresADrift) {
  detectors::HighPass fast(1.0, 0.01);
  fast.settle(0.02);
  double last_m = 0.0;
  for (int i = 0; i < 2000; ++i)
    last_m = fast.step(0.02 + 10e-6 * 0.01 * i);
  CHECK_COMPARE(std::abs(last_m), <, 1e-7);
}

TEST(Response, MotionIsTheRmsOverTheBlock) {
  detectors::Response answer(step_noise_m);
  for (int i = 0; i < 1000; ++i)
    answer.step(0.0, i % 2 == 0 ? 100e-6 : -100e-6);
  CHECK(answer.moved(98e-6));
  CHECK_FALSE(answer.moved(102e-6));
}

TEST(Response, ReportedMarginCarriesAnExternalVerdict) {
  detectors::ReportedMargin reported;
  CHECK_FALSE(reported.step(false, {1e-3, 2e-3, true, true}));
  DOUBLES_EQUAL(2.0, reported.margin().used(), 1e-12);
  CHECK(reported.step(true, {1e-3, 4e-3, true, true}));
  DOUBLES_EQUAL(4.0, reported.margin().used(), 1e-12);
}
