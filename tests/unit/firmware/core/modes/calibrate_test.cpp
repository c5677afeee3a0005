// When calibrate takes the zero, and the progress that it reports until then.
#include "modes/calibrate.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <CppUTest/TestHarness.h>

using namespace supercoil;
using modes::Calibrate;

namespace {

constexpr double step_s = 0.01;
constexpr double tau_s = 5.0;

/// The progress at each step until the zero is known, for a muscle this much warmer than the air.
std::vector<float> progress_from(double begins_K) {
  Calibrate calibrate(Calibrate::Settings{});
  std::vector<float> all;
  for (int i = 0; i < 20000 && !calibrate.knows_zero(); ++i) {
    const double hottest_K = begins_K * std::exp(-i * step_s / tau_s);
    CHECK(calibrate.step(hottest_K, 0.0, step_s) == ModeResult::running);
    all.push_back(calibrate.progress());
  }
  CHECK(calibrate.probed(10.0) == ModeResult::found);
  DOUBLES_EQUAL(1.0, calibrate.progress(), 0.0);
  return all;
}

}  // namespace

TEST_GROUP(CalibrateProgress){};

TEST(CalibrateProgress, GrowsLinearlyWithTime) {
  for (const double begins_K : {0.5, 3.0, 60.0}) {
    const std::vector<float> all = progress_from(begins_K);
    const auto steps = static_cast<double>(all.size());
    for (std::size_t i = 1; i < all.size(); ++i)
      DOUBLES_EQUAL(static_cast<double>(i + 1) / steps, static_cast<double>(all[i]), 0.03);
  }
}

TEST(CalibrateProgress, StaysWhereTheMuscleDoesNotCool) {
  Calibrate calibrate(Calibrate::Settings{});
  for (int i = 0; i < 100; ++i)
    calibrate.step(20.0, 0.0, step_s);
  DOUBLES_EQUAL(0.0, calibrate.progress(), 0.0);
  // Progress never falls, however the bound of the heat moves.
  calibrate.step(10.0, 0.0, step_s);
  const float before = calibrate.progress();
  CHECK(before > 0.0F);
  calibrate.step(19.0, 0.0, step_s);
  DOUBLES_EQUAL(before, calibrate.progress(), 0.0);
}

namespace {

/// A muscle that may have been this hot; its hottest end cools as slowly as its bounds allow.
struct Resting {
  double begins_K = 135.0;
  double noise_rms_m = 10e-6;
  Calibrate::Settings settings{.still_K = 20.0, .max_remaining_m = 20e-6, .count_m = 1e-6};

  /// The hottest that it may be when the zero is taken, if the position moves like this over time.
  template <typename PositionOf>
  double hottest_K_at_zero(PositionOf position_m) const {
    Calibrate calibrate(settings);
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0.0, noise_rms_m);
    double hottest_K = begins_K;
    for (double time_s = 0.0; !calibrate.knows_zero() && time_s < 100.0; time_s += step_s) {
      hottest_K = begins_K * std::exp(-time_s / tau_s);
      calibrate.step(hottest_K, position_m(time_s) + noise(random), step_s);
    }
    return hottest_K;
  }
};

double at_rest(double) {
  return -0.002;
}

}  // namespace

TEST_GROUP(CalibrateStillness){};

TEST(CalibrateStillness, AMotionlessMuscleIsColdBeforeTheWorstCaseTime) {
  const double mean = std::exp(-Calibrate::Settings{}.mean_s / tau_s);
  DOUBLES_EQUAL(20.0 * mean, Resting{}.hottest_K_at_zero(at_rest), 0.2);
  // Without the setting that asks for it, as in a joint, stillness proves nothing.
  Resting strict;
  strict.settings.still_K = 1.0;
  DOUBLES_EQUAL(1.0 * mean, strict.hottest_K_at_zero(at_rest), 0.01);
}

TEST(CalibrateStillness, WaitsForAMuscleThatStillCools) {
  for (const double faster : {1.0, 1.5, 3.0}) {
    double zero_s = 0.0;
    const auto position_m = [&](double time_s) {
      zero_s = time_s;
      return 0.01 * std::exp(-faster * time_s / tau_s);
    };
    const double hottest_K = Resting{}.hottest_K_at_zero(position_m);
    CHECK_COMPARE(hottest_K, <, 15.0);
    // The motion, without noise, that was still to come when the mean began.
    const double remaining_m = position_m(zero_s - Calibrate::Settings{}.mean_s);
    if (hottest_K > 1.0) CHECK_COMPARE(remaining_m, <, 20e-6);
  }
}

TEST(CalibrateStillness, ACoarseOrNoisySensorCannotShowRest) {
  const double mean = std::exp(-Calibrate::Settings{}.mean_s / tau_s);
  Resting coarse;
  coarse.settings.count_m = 1e-3;
  DOUBLES_EQUAL(1.0 * mean, coarse.hottest_K_at_zero(at_rest), 0.01);
  Resting noisy;
  noisy.noise_rms_m = 0.5e-3;
  DOUBLES_EQUAL(1.0 * mean, noisy.hottest_K_at_zero(at_rest), 0.01);
}

TEST(CalibrateStillness, ConstantBoundsDoNotGiveAZero) {
  Calibrate calibrate({.still_K = 20.0, .max_remaining_m = 20e-6});
  for (int i = 0; i < 6000; ++i)
    calibrate.step(15.0, 0.0, step_s);
  CHECK_FALSE(calibrate.knows_zero());
}
