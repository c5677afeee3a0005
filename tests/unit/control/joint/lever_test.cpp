// How far muscles contract at a lever that depends on the angle.
#include "supercoil/control/joint/lever.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <CppUTest/TestHarness.h>
#include <rapidcheck.h>

#include "unit/control/support/generators.hpp"

using supercoil::control::Lever;
using supercoil::test::reals;

namespace {

Lever any_table() {
  const auto points = *rc::gen::inRange<std::size_t>(2, Lever::max_points + 1);
  std::vector<double> radii_m;
  for (std::size_t i = 0; i < points; ++i)
    radii_m.push_back(*reals(0.002, 0.05));
  return {*reals(-1.5, 0.0), *reals(0.1, 1.5), radii_m};
}

}  // namespace

TEST_GROUP(Lever){};

TEST(Lever, AConstantLeverHasACirclesArc) {
  const Lever lever(0.012);
  CHECK(lever.is_constant());
  for (const double angle_rad : {-2.0, -0.1, 0.0, 0.7}) {
    DOUBLES_EQUAL(0.012 * angle_rad, lever.arc_m(angle_rad), 0.0);
    DOUBLES_EQUAL(angle_rad, lever.angle_rad(lever.arc_m(angle_rad)), 1e-15);
    DOUBLES_EQUAL(0.012, lever.radius_m(angle_rad), 0.0);
  }
}

/// r = 10 mm + 4 mm/rad (α + 1) up to α = 0, then falling by 6 mm/rad: the arc is its integral,
/// computed by hand.
TEST(Lever, ATableIsStraightBetweenItsPointsAndConstantBeyond) {
  const std::array<double, 3> radii_m{0.010, 0.014, 0.008};
  const Lever lever(-1.0, 1.0, radii_m);
  CHECK_FALSE(lever.is_constant());
  DOUBLES_EQUAL(0.014, lever.zero_radius_m(), 1e-15);
  DOUBLES_EQUAL(0.012, lever.radius_m(-0.5), 1e-15);
  DOUBLES_EQUAL(0.011, lever.radius_m(0.5), 1e-15);
  DOUBLES_EQUAL(0.010, lever.radius_m(-3.0), 1e-15);
  DOUBLES_EQUAL(0.008, lever.radius_m(3.0), 1e-15);
  DOUBLES_EQUAL(0.0, lever.arc_m(0.0), 1e-18);
  DOUBLES_EQUAL(-0.012, lever.arc_m(-1.0), 1e-15);
  DOUBLES_EQUAL(-0.022, lever.arc_m(-2.0), 1e-15);
  DOUBLES_EQUAL(0.00625, lever.arc_m(0.5), 1e-15);
  DOUBLES_EQUAL(0.011 + 0.5 * 0.008, lever.arc_m(1.5), 1e-15);
  DOUBLES_EQUAL(0.008, lever.min_radius_m(), 0.0);
  DOUBLES_EQUAL(0.014, lever.max_radius_m(), 0.0);
}

TEST(Lever, AngleIsTheInverseOfArc) {
  CHECK(rc::check("inverse", [] {
    const Lever lever = any_table();
    const double angle_rad = *reals(-3.0, 3.0);
    RC_ASSERT(std::abs(lever.angle_rad(lever.arc_m(angle_rad)) - angle_rad) <= 1e-11);
  }));
}

TEST(Lever, TheArcGrowsByTheLeverRadius) {
  CHECK(rc::check("slope", [] {
    const Lever lever = any_table();
    const double angle_rad = *reals(-3.0, 3.0);
    const double step_rad = 1e-6;
    const double grown_m = lever.arc_m(angle_rad + step_rad) - lever.arc_m(angle_rad - step_rad);
    // At a kink it is the mean of both sides.
    RC_ASSERT(std::abs(grown_m / (2.0 * step_rad) - lever.radius_m(angle_rad)) <= 1e-6);
  }));
}

TEST(Lever, NaNInGivesNaNOut) {
  const std::array<double, 4> radii_m{0.010, 0.014, 0.008, 0.009};
  const Lever lever(-1.0, 1.0, radii_m);
  CHECK(std::isnan(lever.arc_m(NAN)));
  CHECK(std::isnan(lever.radius_m(NAN)));
  CHECK(std::isnan(lever.angle_rad(NAN)));
}
