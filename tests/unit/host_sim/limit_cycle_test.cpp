// Which runs are reported to oscillate under a moving reference, and with which period.
#include "runner/limit_cycle.hpp"

#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include <CppUTest/TestHarness.h>

#include "runner/summary.hpp"
#include "unit/host_sim/support/scenarios.hpp"

using namespace supercoil;
using namespace supercoil::host_sim;
using supercoil::test::read;

TEST_GROUP(LimitCycle) {
  LimitCycle cycle;
  double time_s = 0.0;

  /// One cycle, down and up again.
  void turn(double lasts_s) {
    cycle.add(LimitedBy::minimum, time_s + 0.5 * lasts_s);
    cycle.add(LimitedBy::nothing, time_s + 0.7 * lasts_s);
    time_s += lasts_s;
    cycle.add(LimitedBy::maximum, time_s);
  }

  /// The period that a run of this scenario reports; NaN: none.
  static double period_of_run_s(const std::string& text) {
    const Scenario scenario = read(text);
    Simulation simulation(scenario);
    Summary summary({});
    while (!simulation.done())
      summary.add(simulation.step());
    const double period_s = summary.limit_cycle_period_s(scenario);
    std::printf("%s: %g s\n", text.c_str(), period_s);
    return period_s;
  }
};

TEST(LimitCycle, IsDetectedByCyclesOfEqualDuration) {
  for (int i = 0; i < 12; ++i)
    turn(0.5);
  CHECK_TRUE(std::isnan(cycle.period_s(25.0)));
  turn(0.5);
  DOUBLES_EQUAL(0.5, cycle.period_s(25.0), 1e-9);
  // If the reference recurs as fast, it is not a limit cycle.
  CHECK_TRUE(std::isnan(cycle.period_s(1.4)));
  // Time in which nothing is followed does not count.
  cycle.interrupt();
  time_s += 1000.0;
  for (int i = 0; i < 12; ++i)
    turn(0.6);
  DOUBLES_EQUAL(0.6, cycle.period_s(25.0), 0.1 + 1e-9);
}

TEST(LimitCycle, IgnoresNoiseThatReachesBothLimits) {
  std::mt19937 random(1);
  std::exponential_distribution<double> lasts_s(10.0);
  for (int i = 0; i < 1000; ++i)
    turn(lasts_s(random));
  CHECK_TRUE(std::isnan(cycle.period_s(25.0)));
}

TEST(LimitCycle, TooHighAGainIsReportedUnderAMovingReference) {
  const double period_s = period_of_run_s(
      "simulation.duration_s = 60.0\ncontroller = {kind = 'pi', proportional_W_per_m = 8000.0, "
      "integral_W_per_m_s = 9000.0}\n");
  DOUBLES_EQUAL(0.47, period_s, 0.05);
}

/// Noise, steps of a reference, friction, a fast sine and a non-linear muscle are none either.
TEST(LimitCycle, NothingElseIsReported) {
  for (const char* law : {"pi", "learned_ff"}) {
    for (const char* rest :
         {"reference = {kind = 'steps', levels_m = [0.004, 0.016], hold_s = 5.0}\n",
          "plant.friction_ratio = 0.02\n",
          "plant.friction_ratio = 0.02\nreference = {kind = 'sine', offset_m = 0.011, "
          "amplitude_m = 0.002, angular_frequency_rad_per_s = 3.0}\n",
          "plant.preset = 'real_hard'\n"}) {
      const std::string text =
          "simulation.duration_s = 100.0\ncontroller.kind = '" + std::string(law) + "'\n" + rest;
      CHECK_TRUE(std::isnan(period_of_run_s(text)));
    }
  }
}
