#include "board/applied_power.hpp"

#include <CppUTest/TestHarness.h>

using namespace supercoil::board;

TEST_GROUP(OutputDelay){};

TEST(OutputDelay, GivesTheValueSetThatManyTicksAgo) {
  for (const std::size_t ticks :
       {std::size_t{0}, std::size_t{1}, std::size_t{7}, OutputDelay::max_ticks}) {
    OutputDelay delay(ticks);
    for (std::size_t i = 0; i < 3 * (ticks + 1); ++i) {
      const double expected_W = i < ticks ? 0.0 : static_cast<double>(i - ticks + 1);
      const AppliedPower& acting = delay.step({static_cast<double>(i + 1), 0.5, true});
      DOUBLES_EQUAL(expected_W, acting.power_W, 0.0);
      CHECK(acting.limited == (i >= ticks));
      DOUBLES_EQUAL(i < ticks ? 0.0 : 0.5, acting.duty, 0.0);
    }
  }
}

TEST(OutputDelay, IsLimitedToTheDelayLine) {
  OutputDelay delay(OutputDelay::max_ticks + 100);
  for (std::size_t i = 0; i < OutputDelay::max_ticks; ++i)
    DOUBLES_EQUAL(0.0, delay.step({1.0, 0.0, false}).power_W, 0.0);
  DOUBLES_EQUAL(1.0, delay.step({1.0, 0.0, false}).power_W, 0.0);
}
