#include "supercoil/control/tracking/trajectory.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>
#include <rapidcheck.h>

#include "unit/control/support/reference.hpp"

using namespace supercoil::control;

namespace {

Knot knot_from(const nlohmann::json& row) {
  return {row.at(0), row.at(1), row.at(2)};
}

void check_point(const nlohmann::json& c, std::size_t i, const TrajectoryPoint& point) {
  DOUBLES_EQUAL(c.at("position")[i], point.motion.position, 1e-12);
  DOUBLES_EQUAL(c.at("velocity")[i], point.motion.velocity, 1e-10);
  DOUBLES_EQUAL(c.at("acceleration")[i], point.motion.acceleration, 1e-8);
  DOUBLES_EQUAL(c.at("jerk")[i], point.jerk, 1e-5);
}

}  // namespace

TEST_GROUP(Trajectory) {
  Trajectory way;
};

TEST(Trajectory, AgreesWithScipyThroughUnevenKnots) {
  const auto c = supercoil::test::reference("tracking", "trajectory");
  const std::vector<nlohmann::json> knots = c.at("knots");
  way.start(knot_from(knots[0]).position_m);
  for (std::size_t i = 1; i < knots.size(); ++i)
    way.add(knot_from(knots[i]));
  const std::vector<double> times = c.at("time_s");
  for (std::size_t i = 0; i < times.size(); ++i)
    check_point(c, i, way.at(times[i]));
}

TEST(Trajectory, IsTheSameWhenKnotsComeTwoAhead) {
  const auto c = supercoil::test::reference("tracking", "trajectory");
  const std::vector<nlohmann::json> knots = c.at("knots");
  way.start(knot_from(knots[0]).position_m);
  std::size_t added = 1;
  const std::vector<double> times = c.at("time_s");
  for (std::size_t i = 0; i < times.size(); ++i) {
    // Only the next two knots after this time have been added.
    while (added < knots.size() && (added < 3 || knot_from(knots[added - 2]).time_s <= times[i]))
      way.add(knot_from(knots[added++]));
    check_point(c, i, way.at(times[i]));
  }
}

TEST(Trajectory, ANewKnotDoesNotChangeTheCurrentPiece) {
  way.start(0.0);
  way.add({1.0, 0.001, 0.002});
  const double before_m = way.at(0.5).motion.position;
  way.add({2.0, 0.003, 0.0});
  DOUBLES_EQUAL(before_m, way.at(0.5).motion.position, 0.0);
  const auto end = way.at(1.0 - 1e-9);
  const auto beginning = way.at(1.0);
  DOUBLES_EQUAL(end.motion.velocity, beginning.motion.velocity, 1e-9);
  DOUBLES_EQUAL(0.0, beginning.motion.acceleration, 0.0);
}

TEST(Trajectory, RestsAtItsLastKnot) {
  way.start(0.002);
  DOUBLES_EQUAL(0.002, way.at(5.0).motion.position, 0.0);
  way.start(0.0);
  way.add({1.0, 0.001, 0.0});
  const auto after = way.at(1.5);
  DOUBLES_EQUAL(0.001, after.motion.position, 0.0);
  DOUBLES_EQUAL(0.0, after.motion.velocity, 0.0);
}

TEST(Trajectory, PreviewMatchesTheMotionThatFollows) {
  way.start(0.0);
  way.add({1.0, 0.001, 0.001});
  const Knot next{1.5, 0.002, -0.001};
  const auto preview = way.preview(next);
  UNSIGNED_LONGS_EQUAL(0, preview.first);
  way.add(next);
  DOUBLES_EQUAL(preview.pieces[0].at(0.4).motion.position, way.at(0.4).motion.position, 0.0);
  DOUBLES_EQUAL(preview.pieces[1].at(1.3).motion.position, way.at(1.3).motion.position, 0.0);
}

TEST(Trajectory, PreviewAtTheStartHasNoFirstPiece) {
  way.start(0.0);
  UNSIGNED_LONGS_EQUAL(1, way.preview({1.0, 0.001, 0.0}).first);
  way.add({1.0, 0.001, 0.0});
  way.at(0.2);
  UNSIGNED_LONGS_EQUAL(1, way.preview({2.0, 0.0, 0.0}).first);
}

TEST(Trajectory, PassedKnotsFreeTheirRoom) {
  way.start(0.0);
  for (int i = 1; way.room() > 0; ++i)
    way.add({0.1 * i, 1e-4 * i, 1e-3});
  UNSIGNED_LONGS_EQUAL(0, way.room());
  way.at(0.35);
  UNSIGNED_LONGS_EQUAL(3, way.room());
  DOUBLES_EQUAL(6.3, way.last().time_s, 1e-9);
  way.start(0.0);
  UNSIGNED_LONGS_EQUAL(Trajectory::capacity - 1, way.room());
}

TEST(Trajectory, IsSmoothForAnyKnotsAtAnyTime) {
  CHECK(rc::check("position, velocity and acceleration are continuous", [] {
    Trajectory moving;
    moving.start(0.0);
    double time_s = 0.0;
    Knot last{};
    for (int i = 0; i < 40; ++i) {
      if (*rc::gen::inRange(0, 3) != 0 && moving.room() > 0) {
        const double duration_s = 0.02 * *rc::gen::inRange(1, 20);
        last = {std::fmax(last.time_s, time_s) + duration_s, 1e-4 * *rc::gen::inRange(-100, 100),
                i % 7 == 0 ? 0.0 : 1e-4 * *rc::gen::inRange(-100, 100)};
        moving.add(last);
      }
      for (int ticks = *rc::gen::inRange(1, 100); ticks > 0; --ticks, time_s += 1e-3) {
        // After a last knot that still moves it stops, as it must.
        if (moving.last().velocity_m_per_s != 0.0 && time_s >= moving.last().time_s - 2e-3)
          continue;
        const auto now = moving.at(time_s);
        const auto next = moving.at(time_s + 1e-9);
        RC_ASSERT(std::abs(next.motion.position - now.motion.position) < 1e-7);
        RC_ASSERT(std::abs(next.motion.velocity - now.motion.velocity) < 1e-5);
        RC_ASSERT(std::abs(next.motion.acceleration - now.motion.acceleration) < 1e-2);
      }
    }
  }));
}
