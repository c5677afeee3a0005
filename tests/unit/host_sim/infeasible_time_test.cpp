// The fraction of a run with a reference that the muscle could not follow.
#include "runner/infeasible_time.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>

#include "runner/reference_feasibility.hpp"
#include "unit/host_sim/support/scenarios.hpp"

using namespace supercoil;
using namespace supercoil::host_sim;

TEST_GROUP(InfeasibleTime) {
  static constexpr double step_s = 0.001;
  InfeasibleTime found;
  double time_s = 0.0;

  void follow(LimitedBy limit, double duration_s) {
    const double end_s = time_s + duration_s;
    for (; time_s < end_s - 0.5 * step_s; time_s += step_s)
      found.add(limit, time_s);
  }
};

TEST(InfeasibleTime, CountsLimitsThatLastFromTheirStart) {
  follow(LimitedBy::nothing, 1.0);
  follow(LimitedBy::minimum, 0.19);
  follow(LimitedBy::slew, 0.01);
  follow(LimitedBy::minimum, 0.19);
  follow(LimitedBy::nothing, 0.61);
  DOUBLES_EQUAL(0.0, found.ratio(), 0.0);
  CHECK_TRUE(std::isnan(found.first_s()));
  // One limit after the other.
  follow(LimitedBy::maximum, 0.1);
  follow(LimitedBy::temperature, 0.4);
  DOUBLES_EQUAL(0.5 / 2.5, found.ratio(), 1e-9);
  DOUBLES_EQUAL(2.0, found.first_s(), 1e-9);
  CHECK(found.main_limit() == LimitedBy::temperature);
}

TEST(InfeasibleTime, EndsWhenNoPositionIsTracked) {
  for (int i = 0; i < 10; ++i) {
    follow(LimitedBy::cooling, 0.15);
    found.interrupt();
  }
  DOUBLES_EQUAL(0.0, found.ratio(), 0.0);
}

TEST(InfeasibleTime, NamesThePrecedingEventWithAllItsChanges) {
  const Scenario scenario = test::read(
      "[[event]]\nat_s = 0.5\nplant.load_N = 0.01\n[[event]]\nat_s = 1.0\n"
      "plant.load_N = 0.05\npower.gain = 0.9\n[[event]]\nat_s = 1.0\nreset = true\n"
      "[[event]]\nat_s = 9.0\npower.gain = 1.0\n");
  follow(LimitedBy::nothing, 1.5);
  follow(LimitedBy::temperature, 0.5);
  STRCMP_EQUAL(
      "the reference asked for more than the muscle can do, first at 1.5 s for 0.499 s and in 25.0 "
      "% of all ticks that followed it, after the event at 1 s (plant.load_N, power.gain), mostly "
      "limited_by "
      "temperature: use a smaller reference",
      describe_infeasible(found, scenario).c_str());
}

TEST(InfeasibleTime, StartsAndEndsWithTheReference) {
  const auto follow_requested = [&](LimitedBy limit, bool requested, double end_s) {
    for (; time_s < end_s - 0.5 * step_s; time_s += step_s)
      found.add(limit, requested, time_s);
  };
  // At a limit, although the reference does not ask for it.
  follow_requested(LimitedBy::minimum, false, 1.0);
  CHECK_FALSE(found.found());
  follow_requested(LimitedBy::nothing, true, 2.0);
  CHECK_FALSE(found.found());
  follow_requested(LimitedBy::maximum, true, 3.0);
  // A gap due to noise.
  follow_requested(LimitedBy::nothing, true, 3.1);
  follow_requested(LimitedBy::maximum, true, 4.0);
  follow_requested(LimitedBy::minimum, false, 5.0);
  DOUBLES_EQUAL(1.0, found.first_s(), 1e-9);
  DOUBLES_EQUAL(3.0, found.first_duration_s(), 2.0 * step_s);
  CHECK_TRUE(found.first_ended());
  DOUBLES_EQUAL(1.9 / 5.0, found.ratio(), 1e-3);
}
