#include "board/power_stage.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>

using supercoil::board::PowerStage;

TEST_GROUP(PowerStage){};

TEST(PowerStage, DutyIsPowerTimesResistanceOverVoltageSquared) {
  PowerStage stage({1000000, false});
  // Other projects made this mistake: √(1.5·10)/12 = 0.323 would give 4.6 W.
  const auto out = stage.step(1.5, 10.0, 12.0, 1e3);
  DOUBLES_EQUAL(1.5 * 10.0 / 144.0, out.duty, 1e-6);
  DOUBLES_EQUAL(1.5, out.applied_W, 1e-5);
  CHECK_FALSE(out.clipped);
}

TEST(PowerStage, ReportsThePowerOfItsQuantisedDuty) {
  PowerStage stage({255, false});
  const auto out = stage.step(1.0, 10.0, 12.0, 1e3);
  LONGS_EQUAL(18, out.step);
  DOUBLES_EQUAL(18.0 / 255.0 * 14.4, out.applied_W, 1e-12);
}

TEST(PowerStage, CannotGiveMoreThanTheSupply) {
  PowerStage stage({4095, true});
  const auto out = stage.step(20.0, 10.0, 12.0, 1e3);
  LONGS_EQUAL(4095, out.step);
  DOUBLES_EQUAL(14.4, out.applied_W, 1e-12);
  CHECK(out.clipped);
}

TEST(PowerStage, ErrorFeedbackGivesTheWantedPowerOnAverage) {
  PowerStage with({255, true});
  PowerStage without({255, false});
  double sum_with = 0.0;
  double sum_without = 0.0;
  for (int i = 0; i < 5000; ++i) {
    sum_with += with.step(1.0, 10.0, 12.0, 1e3).applied_W;
    sum_without += without.step(1.0, 10.0, 12.0, 1e3).applied_W;
  }
  DOUBLES_EQUAL(1.0, sum_with / 5000.0, 1e-4);
  CHECK_COMPARE(std::abs(sum_without / 5000.0 - 1.0), >, 0.01);
}

TEST(PowerStage, GivesNothingForNonPositiveOrNaNRequests) {
  PowerStage stage({4095, true});
  const double nan = std::nan("");
  const double inputs[][3] = {{nan, 10.0, 12.0},     {1.0, nan, 12.0},    {1.0, 10.0, nan},
                              {1.0, 0.0, 12.0},      {1.0, -5.0, 12.0},   {1.0, 10.0, 0.0},
                              {1.0, 10.0, -12.0},    {1.0, 1e-320, 12.0}, {-1.0, 10.0, 12.0},
                              {1.0, 10.0, INFINITY}, {0.0, 10.0, 12.0},   {1.0, INFINITY, 12.0}};
  for (const auto& in : inputs) {
    const auto out = stage.step(in[0], in[1], in[2], 1e3);
    LONGS_EQUAL(0, out.step);
    DOUBLES_EQUAL(0.0, out.applied_W, 0.0);
  }
}

TEST(PowerStage, GivesNothingWhereNoPowerIsAllowed) {
  PowerStage stage({4095, true});
  for (const double max_W : {0.0, -1.0, std::nan("")}) {
    const auto out = stage.step(1.0, 10.0, 12.0, max_W);
    LONGS_EQUAL(0, out.step);
    DOUBLES_EQUAL(0.0, out.duty, 0.0);
    DOUBLES_EQUAL(0.0, out.applied_W, 0.0);
  }
}

TEST(PowerStage, ResetClearsTheErrorFeedback) {
  PowerStage fresh({255, true});
  PowerStage used({255, true});
  for (int i = 0; i < 3; ++i)
    static_cast<void>(used.step(1.0, 10.0, 12.0, 1e3));
  used.reset();
  for (int i = 0; i < 20; ++i)
    LONGS_EQUAL(fresh.step(1.0, 10.0, 12.0, 1e3).step, used.step(1.0, 10.0, 12.0, 1e3).step);
}
