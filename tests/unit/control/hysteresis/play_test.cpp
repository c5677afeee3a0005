// The play operator against its definition.
#include "supercoil/control/hysteresis/play.hpp"

#include <CppUTest/TestHarness.h>

using supercoil::control::Play;

TEST_GROUP(PlayOperator){};

TEST(PlayOperator, RestsWithinItsRadiusAndIsCarriedBeyond) {
  Play play(0.2);
  play.step(0.15);
  DOUBLES_EQUAL(0.0, play.output(), 0.0);
  CHECK_FALSE(play.engaged());
  play.step(1.0);
  DOUBLES_EQUAL(0.8, play.output(), 1e-12);
  CHECK_TRUE(play.engaged());
  play.step(0.7);
  DOUBLES_EQUAL(0.8, play.output(), 1e-12);
  CHECK_FALSE(play.engaged());
  play.step(0.5);
  DOUBLES_EQUAL(0.7, play.output(), 1e-12);
}

TEST(PlayOperator, ForgetsASmallerLoopWithinALargerOne) {
  Play once(0.1);
  Play with_loop(0.1);
  for (const double x : {0.0, 1.0, 0.0})
    once.step(x);
  for (const double x : {0.0, 1.0, 0.6, 0.8, 0.0})
    with_loop.step(x);
  DOUBLES_EQUAL(once.output(), with_loop.output(), 0.0);
}
