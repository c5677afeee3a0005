#include "board/power_bounds.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>
#include <rapidcheck.h>

#include "unit/control/support/generators.hpp"

using namespace supercoil;
using board::Measured;
using board::PowerBounds;

namespace {

constexpr double cold_Ohm = 10.0;

Measured present(double current_A) {
  return {current_A, 0.0, true, hal::Status::ok};
}

PowerBounds::Settings settings() {
  PowerBounds::Settings s;
  s.min_supply_V = 10.8;
  s.max_supply_V = 13.2;
  return s;
}

PowerBounds compared(double error_ratio) {
  PowerBounds bounds(settings());
  bounds.set({1.0, 1.0, error_ratio, 0.0});
  return bounds;
}

/// What a board reads from a heater of 10 Ohm, and its true power.
struct Reading {
  double duty;
  double supply_V;
  double current_A;
  double true_W;
};

Reading read(double duty, double true_V, double supply_gain, double current_gain) {
  const double true_A = duty * true_V / cold_Ohm;
  return {duty, supply_gain * true_V, current_gain * true_A, true_V * true_A};
}

void check_holds(const PowerBounds& bounds, const Reading& r) {
  const auto bound_W = bounds.step(r.duty, r.supply_V, present(r.current_A), {cold_Ohm, cold_Ohm});
  RC_ASSERT(bound_W.min <= r.true_W + 1e-12);
  RC_ASSERT(bound_W.max >= r.true_W - 1e-12);
}

}  // namespace

TEST_GROUP(PowerBounds){};

TEST(PowerBounds, ContainTheTruthForAnyUndetectedSenseErrors) {
  CHECK(rc::check("gains that neither supply nor resistance show", [] {
    const double true_V = *test::reals(10.8, 13.2);
    const double supply_gain = *test::reals(10.8 / true_V, 13.2 / true_V);
    const double current_gain = supply_gain * *test::reals(1.0 / 1.3, 1.0 / 0.7);
    check_holds(PowerBounds(settings()),
                read(*test::reals(0.0, 1.0), true_V, supply_gain, current_gain));
  }));
}

TEST(PowerBounds, ContainTheTruthWithinTheErrorLeftByAComparison) {
  CHECK(rc::check("gains within the remaining error", [] {
    // Measured over true is the inverse of the ratio that the comparison bounds.
    const double supply_gain = 1.0 / *test::reals(0.97, 1.03);
    const double current_gain = 1.0 / *test::reals(0.97, 1.03);
    check_holds(compared(0.03), read(*test::reals(0.0, 1.0), 12.0, supply_gain, current_gain));
  }));
}

TEST(PowerBounds, AreNoWiderThanTheWorstCaseAtAnySupply) {
  CHECK(rc::check("a supply that is no fault", [] {
    const double supply_V = *test::reals(10.8, 13.2);
    for (const PowerBounds& bounds : {PowerBounds(settings()), compared(0.02)}) {
      const auto here = bounds.true_over_measured(supply_V);
      const auto worst = bounds.true_over_measured();
      RC_ASSERT(here.max <= worst.max + 1e-12 && here.min >= worst.min - 1e-12);
    }
  }));
  DOUBLES_EQUAL(1.3 * std::pow(13.2 / 10.8, 2), PowerBounds(settings()).true_over_measured().max,
                1e-9);
}

TEST(PowerBounds, OfComparedSensesAreNarrow) {
  const auto power_W = compared(0.02).step(0.3, 12.0, present(0.36), {cold_Ohm, cold_Ohm});
  DOUBLES_EQUAL(4.32 * 1.02 * 1.02, power_W.max, 1e-9);
  CHECK_COMPARE(power_W.min, >, 0.7 * 4.32);
}

TEST(PowerBounds, IncludeACurrentAtZeroDuty) {
  const auto power_W = compared(0.02).step(0.0, 12.0, present(0.51), {cold_Ohm, cold_Ohm});
  DOUBLES_EQUAL(12.0 * 0.5 * 1.02 * 1.02, power_W.max, 1e-9);
  DOUBLES_EQUAL(0.0, power_W.min, 0.0);
}

TEST(PowerBounds, IncludeADutyWithoutSensedCurrent) {
  const auto power_W = compared(0.02).step(0.3, 12.0, present(0.0), {cold_Ohm, cold_Ohm});
  DOUBLES_EQUAL(4.32 * 1.02 * 1.02, power_W.max, 1e-9);
  DOUBLES_EQUAL(0.0, power_W.min, 0.0);
}

TEST(PowerBounds, WithoutAReadingReachTheMaxPower) {
  for (const PowerBounds& bounds : {PowerBounds(settings()), compared(0.02)}) {
    Measured absent = present(0.36);
    absent.present = false;
    DOUBLES_EQUAL(4.5, bounds.step(0.0, 12.0, absent, {cold_Ohm, cold_Ohm}).max, 1e-12);
    DOUBLES_EQUAL(0.5 * 13.2 * 13.2 / cold_Ohm,
                  bounds.step(0.5, 0.0, present(0.6), {cold_Ohm, cold_Ohm}).max, 1e-12);
    DOUBLES_EQUAL(0.0, bounds.step(0.5, 12.0, absent, {cold_Ohm, cold_Ohm}).min, 0.0);
  }
}

TEST(PowerBounds, OfUncomparedSensesTakeTheLowerOfDutyAndSense) {
  // The sense reads more current than the duty allows: the duty sets the lower bound.
  const auto power_W = PowerBounds(settings()).step(0.3, 12.0, present(0.5), {cold_Ohm, cold_Ohm});
  DOUBLES_EQUAL(0.3 * 10.8 * 10.8 / (1.3 * cold_Ohm), power_W.min, 1e-9);
  // Where it reads less, the sense sets it, reduced by possible noise.
  const auto less_W = PowerBounds(settings()).step(0.3, 12.0, present(0.31), {cold_Ohm, cold_Ohm});
  DOUBLES_EQUAL(10.8 * 0.3 * (10.8 / 12.0) / 1.3, less_W.min, 1e-9);
}
