// A trajectory that is loaded, started and played to its end, or refused.
#include "loop/playback.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>

#include "supercoil/control/actuator/parameters.hpp"

using namespace supercoil;
using namespace std::chrono_literals;

TEST_GROUP(Playback) {
  const control::PhysicalParameters muscle{};
  Playback::Capability capability{.theta = control::theta_from(muscle),
                                  .moving_mass_kg = muscle.moving_mass_kg,
                                  .max_reverse_travel_m = 0.020,
                                  .max_travel_m = 0.025,
                                  .range = {0.0, 4.5}};
  supercoil::Playback playback;
  hal::Time now = 100s;

  Refusal add(double after_s, double position_m, double velocity_m_per_s = 0.0) {
    Command knot{0, Verb::knot, position_m};
    knot.after_s = static_cast<float>(after_s);
    knot.velocity_m_per_s = static_cast<float>(velocity_m_per_s);
    return playback.add(knot, capability).refusal;
  }
  /// From 5 mm to 6 mm in 2 s.
  void load() {
    CHECK(add(0.0, 0.005) == Refusal::none);
    CHECK(add(2.0, 0.006) == Refusal::none);
  }
  Refusal start(hal::Duration after = 10ms, Source source = Source::can) {
    return playback.start(now + after, now, 0.005, source).refusal;
  }
  /// The position this much later.
  double step(hal::Duration later) {
    double position_m = 0.0;
    for (const hal::Time end = now + later; now < end;) {
      now += 1ms;
      position_m = playback.step(now, 0.005);
    }
    return position_m;
  }
  PlaybackState state() const {
    return playback.status().state;
  }
};

TEST(Playback, MovesFromThePresentPositionToItsLastKnotAndStays) {
  load();
  CHECK(state() == PlaybackState::loaded);
  DOUBLES_EQUAL(0.005, step(50ms), 0.0);
  CHECK(start() == Refusal::none);
  CHECK(state() == PlaybackState::waiting);
  DOUBLES_EQUAL(0.005, step(9ms), 0.0);
  CHECK(state() == PlaybackState::waiting);
  step(1ms);
  CHECK(state() == PlaybackState::playing);
  DOUBLES_EQUAL(0.0055, step(1s), 1e-9);
  DOUBLES_EQUAL(1.0, static_cast<double>(playback.status().buffered_s), 1e-6);
  step(999ms);
  CHECK(state() == PlaybackState::playing);
  DOUBLES_EQUAL(0.006, step(1ms), 0.0);
  CHECK(state() == PlaybackState::ended);
  DOUBLES_EQUAL(0.006, step(60s), 0.0);
  CHECK_FALSE(playback.is_over());
}

TEST(Playback, PositionDoesNotDependOnTheTickOfTheStart) {
  load();
  start(10ms);
  // Half a tick after its start.
  now += 10ms + 500us;
  DOUBLES_EQUAL(0.005, playback.step(now, 0.005), 1e-12);
  now += 999ms + 500us;
  DOUBLES_EQUAL(0.0055, playback.step(now, 0.005), 1e-9);
}

TEST(Playback, RunsDryHoldsAndIsOverASecondLater) {
  CHECK(add(0.0, 0.005) == Refusal::none);
  CHECK(add(1.0, 0.0055, 0.001) == Refusal::none);
  start(1ms);
  DOUBLES_EQUAL(0.0055, step(1002ms), 0.0);
  CHECK(state() == PlaybackState::dry);
  CHECK(add(1.0, 0.006) == Refusal::wrong_state);
  step(990ms);
  CHECK_FALSE(playback.is_over());
  step(20ms);
  CHECK(playback.is_over());
  playback.forget();
  CHECK_FALSE(playback.is_over());
  CHECK(state() == PlaybackState::empty);
}

TEST(Playback, ContinuesWithKnotsThatArriveInTime) {
  CHECK(add(0.0, 0.005) == Refusal::none);
  CHECK(add(1.0, 0.0055, 0.0005) == Refusal::none);
  start(1ms);
  step(600ms);
  CHECK(add(1.0, 0.006, 0.0005) == Refusal::none);
  step(1s);
  CHECK(add(1.0, 0.0065, 0.0) == Refusal::none);
  DOUBLES_EQUAL(0.0065, step(2s), 0.0);
  CHECK(state() == PlaybackState::ended);
}

TEST(Playback, RefusesAnInfeasibleKnotOnArrival) {
  CHECK(add(0.0, 0.005) == Refusal::none);
  CHECK(add(0.2, 0.015) == Refusal::infeasible);  // heat
  CHECK(add(0.2, 0.001) == Refusal::infeasible);  // cooling
  CHECK(add(2.0, 0.006, 0.1) == Refusal::infeasible);
  CHECK(add(1.0, 0.0251) == Refusal::out_of_range);
  CHECK(add(1.0, -0.0201) == Refusal::out_of_range);
  CHECK(add(1.0, std::nan("")) == Refusal::out_of_range);
  CHECK(add(1.0, 0.005, std::nan("")) == Refusal::out_of_range);
  CHECK(add(std::nan(""), 0.005) == Refusal::out_of_range);
  CHECK(add(-1.0, 0.005) == Refusal::out_of_range);
  // The way to the previous knot was feasible, but this knot bends it too far.
  CHECK(add(0.5, 0.0055, 0.002) == Refusal::none);
  CHECK(add(0.05, 0.0055, 0.0) == Refusal::infeasible);
  LONGS_EQUAL(control::Trajectory::capacity - 2, playback.status().room);
}

TEST(Playback, LeavesAPowerMarginForTracking) {
  const double hold_W = capability.theta[3] * 0.006;  // to hold 6 mm permanently
  capability.range.max_W = hold_W / 1.04;
  CHECK(add(0.0, 0.006) == Refusal::none);
  CHECK(add(5.0, 0.006) == Refusal::none);
  capability.range.max_W = hold_W / 1.06;
  CHECK(add(5.0, 0.006) == Refusal::infeasible);
}

TEST(Playback, RefusesAPathThatLeavesTheTravelBetweenKnots) {
  capability.range = {-9.0, 9.0};  // for a joint
  CHECK(add(0.0, 0.0229) == Refusal::none);
  CHECK(add(2.0, 0.0249, 0.001) == Refusal::none);
  CHECK(add(2.0, 0.0249, -0.001) == Refusal::infeasible);
  CHECK(add(2.0, 0.0229, 0.0) == Refusal::infeasible);
  playback.forget();
  CHECK(add(0.0, -0.0179) == Refusal::none);
  CHECK(add(2.0, -0.0199, -0.001) == Refusal::none);
  CHECK(add(2.0, -0.0199, 0.001) == Refusal::infeasible);
  CHECK(add(2.0, -0.0179, 0.0) == Refusal::infeasible);
}

TEST(Playback, StartsOnceAtItsFirstKnotAndNotInThePast) {
  CHECK(start() == Refusal::wrong_state);
  CHECK(add(1.0, 0.006) == Refusal::wrong_state);
  CHECK(add(0.0, 0.005, 0.001) == Refusal::out_of_range);
  load();
  CHECK(start(-1ms) == Refusal::out_of_range);
  CHECK(start(61s) == Refusal::out_of_range);
  CHECK(playback.start(now + 1ms, now, 0.00501, Source::can).refusal == Refusal::not_ready);
  CHECK(start(0ms) == Refusal::none);  // now is not the past
  CHECK(start() == Refusal::wrong_state);
  CHECK(add(0.0, 0.005) == Refusal::busy);
  step(5s);
  // Playback has ended: another trajectory may follow.
  CHECK(add(0.0, 0.006) == Refusal::none);
  CHECK(state() == PlaybackState::loaded);
}

TEST(Playback, TakesNoMoreKnotsThanItHasRoomFor) {
  CHECK(add(0.0, 0.005) == Refusal::none);
  while (playback.status().room > 0)
    CHECK(add(1.0, 0.005) == Refusal::none);
  CHECK(add(1.0, 0.005) == Refusal::queue_full);
  start(1ms);
  step(1010ms);
  LONGS_EQUAL(1, playback.status().room);
  CHECK(add(1.0, 0.005) == Refusal::none);
}

TEST(Playback, FollowsTheClockOfItsBusWithoutAJump) {
  load();
  playback.align(0.005);  // for an earlier trajectory
  start(1ms);
  step(501ms);
  const double x = 0.5 / 2.0;
  DOUBLES_EQUAL(0.005 + 0.001 * x * x * x * (10.0 - 15.0 * x + 6.0 * x * x),
                playback.step(now, 0.005), 1e-9);
  playback.align(0.0002);
  const double before_m = step(1ms);
  CHECK(step(1ms) - before_m < 1.1 * (before_m - 0.005) / 100.0);
  // 0.2 ms ahead after 0.2 s; the offsets of another clock are ignored.
  step(498ms);
  for (const double others_s : {0.011, -0.011, std::nan(""), static_cast<double>(INFINITY)}) {
    playback.align(others_s);
    step(100ms);
  }
  playback.align(0.0002);
  const double y = 1.4002 / 2.0;
  DOUBLES_EQUAL(0.005 + 0.001 * y * y * y * (10.0 - 15.0 * y + 6.0 * y * y),
                playback.step(now, 0.005), 1e-9);
}

TEST(Playback, ALocalStartUsesTheBoardsClock) {
  load();
  start(1ms, Source::local);
  step(1ms);
  playback.align(0.009);  // by an earlier start over a bus
  step(1000ms);
  DOUBLES_EQUAL(0.0055, playback.step(now, 0.005), 1e-9);
}

TEST(Playback, RefusesKnotsBackInTimeOrMoreThanAMinuteApart) {
  CHECK(add(0.0, 0.005) == Refusal::none);
  for (const double after_s : {-1.0, 60.1, 1e300, std::nan("")})
    CHECK(add(after_s, 0.005) == Refusal::out_of_range);
  CHECK(add(60.0, 0.005) == Refusal::none);
}
