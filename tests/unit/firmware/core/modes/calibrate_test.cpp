// How far calibrate says that it is, while the muscle cools.
#include "modes/calibrate.hpp"

#include <cmath>
#include <vector>

#include <CppUTest/TestHarness.h>

using namespace supercoil;
using modes::Calibrate;

namespace {

constexpr double step_s = 0.01;
constexpr double tau_s = 5.0;

/// Of each step until its zero is known, of a muscle that was this much warmer than the air.
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

TEST(CalibrateProgress, GrowsEvenlyWithTimeSoThatWhatIsLeftCanBeTold) {
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
  // It never falls, however the bound of its heat moves.
  calibrate.step(10.0, 0.0, step_s);
  const float before = calibrate.progress();
  CHECK(before > 0.0F);
  calibrate.step(19.0, 0.0, step_s);
  DOUBLES_EQUAL(before, calibrate.progress(), 0.0);
}
