// Which share of the learned power proves itself, on powers whose right share is known.
#include "supercoil/control/tracking/learned_share.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>

using supercoil::control::LearnedShare;

namespace {

constexpr double observation_period_s = 0.01;

/// Two minutes of swings of 1 W: the remaining power is `true_share` of the learned power plus an
/// unrelated swing of `other_W`.
double share_of(double true_share, double other_W, LearnedShare share) {
  for (int k = 0; k < 12'000; ++k) {
    const double learned_W = std::sin(0.9 * k * observation_period_s);
    share.step(true_share * learned_W + other_W * std::sin(2.3 * k * observation_period_s),
               learned_W, true);
  }
  return share.value();
}

LearnedShare usual() {
  return LearnedShare({.period_s = observation_period_s, .min_W = 0.01}, 1.0);
}

}  // namespace

TEST_GROUP(LearnedShare){};

TEST(LearnedShare, IsFullUnlessLearningDoesHarm) {
  DOUBLES_EQUAL(1.0, usual().value(), 0.0);
  DOUBLES_EQUAL(1.0, share_of(1.0, 0.0, usual()), 0.0);
  DOUBLES_EQUAL(1.0, share_of(1.0, 0.7, usual()), 0.0);
  // Twice the right power is no better and no worse than none.
  DOUBLES_EQUAL(1.0, share_of(0.55, 0.0, usual()), 0.0);
  DOUBLES_EQUAL(0.5, share_of(0.25, 0.0, usual()), 0.05);
}

TEST(LearnedShare, IsZeroForUnrelatedOrOpposedPower) {
  CHECK(share_of(0.0, 1.0, usual()) < 0.1);
  DOUBLES_EQUAL(0.0, share_of(-0.5, 0.0, usual()), 0.0);
}

TEST(LearnedShare, AConstantDifferenceIsLeftToTheIntegral) {
  LearnedShare share = usual();
  for (int k = 0; k < 12'000; ++k) {
    const double learned_W = std::sin(0.9 * k * observation_period_s);
    share.step(learned_W - 3.0, learned_W, true);
  }
  DOUBLES_EQUAL(1.0, share.value(), 0.0);
}

TEST(LearnedShare, TenSecondsOfLargeDisturbanceDoNotDominateForMinutes) {
  LearnedShare share = usual();
  for (int k = 0; k < 12'000; ++k) {
    share.step(std::sin(0.9 * k * observation_period_s), std::sin(0.9 * k * observation_period_s),
               true);
  }
  for (int k = 0; k < 1'000; ++k) {
    share.step(-30.0 * std::sin(2.0 * k * observation_period_s),
               30.0 * std::sin(2.0 * k * observation_period_s), true);
  }
  DOUBLES_EQUAL(1.0, share_of(1.0, 0.0, share), 0.0);
}

TEST(LearnedShare, UninformativeSamplesDoNotCount) {
  LearnedShare share = usual();
  for (int k = 0; k < 12'000; ++k) {
    share.step(-std::sin(0.9 * k * observation_period_s), std::sin(0.9 * k * observation_period_s),
               false);
  }
  DOUBLES_EQUAL(1.0, share.value(), 0.0);
}
