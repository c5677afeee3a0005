#include "simulated_board/power_output.hpp"

#include <cmath>
#include <vector>

#include <CppUTest/TestHarness.h>

using namespace supercoil::host_sim;

namespace {

constexpr double step_s = 1e-3;

PowerSettings quantised(int bits, bool feedback) {
  PowerSettings settings;
  settings.pwm_bits = bits;
  settings.error_feedback = feedback;
  return settings;
}

double mean_of(PowerOutput& output, double wanted, int ticks) {
  double sum = 0.0;
  for (int i = 0; i < ticks; ++i) {
    output.want(wanted);
    sum += output.applied_W();
  }
  return sum / ticks;
}

}  // namespace

TEST_GROUP(PowerOutput){};

TEST(PowerOutput, ClipsToItsRangeAndSaysSo) {
  PowerOutput output({}, step_s);
  output.want(9.0);
  DOUBLES_EQUAL(4.5, output.applied_W(), 0.0);
  CHECK(output.limited());
  output.want(-1.0);
  DOUBLES_EQUAL(0.0, output.applied_W(), 0.0);
  CHECK(output.limited());
  output.want(2.0);
  DOUBLES_EQUAL(2.0, output.applied_W(), 0.0);
  CHECK_FALSE(output.limited());
}

TEST(PowerOutput, HeatsNothingForANaN) {
  PowerOutput output({}, step_s);
  output.want(std::nan(""));
  DOUBLES_EQUAL(0.0, output.applied_W(), 0.0);
  CHECK(output.limited());
}

TEST(PowerOutput, RoundsToTheStepsOfItsPwm) {
  PowerOutput output(quantised(12, false), step_s);
  const double step_W = 14.4 / 4095.0;
  output.want(1.0);
  DOUBLES_EQUAL(std::nearbyint(1.0 / step_W) * step_W, output.applied_W(), 1e-12);
  CHECK_COMPARE(std::abs(output.applied_W() - 1.0), >, 1e-6);
}

TEST(PowerOutput, MeetsTheWantedPowerOnAverageWithErrorFeedbackOnly) {
  PowerOutput with(quantised(8, true), step_s);
  PowerOutput without(quantised(8, false), step_s);
  DOUBLES_EQUAL(1.01, mean_of(with, 1.01, 4096), 1e-4);
  CHECK_COMPARE(std::abs(mean_of(without, 1.01, 4096) - 1.01), >, 5e-3);
}

TEST(PowerOutput, DelaysByWholeTicks) {
  PowerSettings settings;
  settings.delay_s = 0.003;
  PowerOutput output(settings, step_s);
  std::vector<double> applied;
  for (int tick = 0; tick < 6; ++tick) {
    output.want(1.0 + 0.1 * tick);
    applied.push_back(output.applied_W());
  }
  DOUBLES_EQUAL(0.0, applied[2], 0.0);
  DOUBLES_EQUAL(1.0, applied[3], 0.0);
  DOUBLES_EQUAL(1.2, applied[5], 1e-15);
}

TEST(PowerOutput, GivesTheMuscleMoreThanItReportsWhenItsGainIsWrong) {
  PowerSettings settings;
  settings.gain = 1.2;
  PowerOutput output(settings, step_s);
  output.want(2.0);
  DOUBLES_EQUAL(2.0, output.applied_W(), 0.0);
  DOUBLES_EQUAL(2.4, output.true_W(), 1e-15);
}

TEST(PowerOutput, KeepsItsLimitsWhateverItsSteps) {
  for (const int bits : {4, 6, 8, 12}) {
    for (const bool feedback : {false, true}) {
      PowerSettings settings = quantised(bits, feedback);
      settings.min_W = 1.0;
      PowerOutput output(settings, step_s);
      for (int tick = 0; tick < 2000; ++tick) {
        output.want(tick % 2 == 0 ? 4.499 : 0.3 + 0.004 * tick);
        CHECK(output.applied_W() <= 4.5 && output.applied_W() >= 1.0);
      }
    }
  }
}

TEST(PowerOutput, ALongerDelayActsOnWhatWasAskedForThen) {
  PowerOutput output({}, step_s);
  for (int tick = 0; tick < 100; ++tick)
    output.want(2.0);
  PowerSettings delayed;
  delayed.delay_s = 0.020;
  output.set(delayed);
  for (int tick = 0; tick < 20; ++tick) {
    output.want(4.0);
    DOUBLES_EQUAL(2.0, output.applied_W(), 0.0);
  }
  output.want(4.0);
  DOUBLES_EQUAL(4.0, output.applied_W(), 0.0);
}

TEST(PowerOutput, LimitedBelongsToThePowerThatActs) {
  PowerSettings settings;
  settings.delay_s = 0.002;
  PowerOutput output(settings, step_s);
  output.want(9.0);
  CHECK_FALSE(output.limited());
  output.want(1.0);
  CHECK_FALSE(output.limited());
  output.want(1.0);
  CHECK(output.limited());
  output.want(1.0);
  CHECK_FALSE(output.limited());
}
