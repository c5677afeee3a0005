// The effort of a joint, divided between two muscles.
#include "supercoil/control/joint/allocation.hpp"

#include <algorithm>
#include <cmath>

#include <CppUTest/TestHarness.h>
#include <rapidcheck.h>

#include "unit/control/support/generators.hpp"

using namespace supercoil::control;
using supercoil::test::reals;

namespace {

constexpr double rounding_W = 1e-12;

/// Any pair of heaters, with an antagonist that is stronger or weaker than the agonist.
struct AnyPair {
  double gain_ratio = *reals(0.2, 5.0);
  JointAllocation::Ranges ranges{{*reals(0.0, 0.5), *reals(0.6, 10.0)},
                                 {*reals(0.0, 0.5), *reals(0.6, 10.0)}};
  double effort_W = *reals(-20.0, 20.0);
  double co_contraction_W = *reals(0.0, 12.0);
  JointAllocation allocation{gain_ratio};

  PairPower divided() const { return allocation.divide(effort_W, co_contraction_W, ranges); }
};

bool within(double power_W, const PowerRange& range) {
  return power_W >= range.min_W - rounding_W && power_W <= range.max_W + rounding_W;
}

}  // namespace

TEST_GROUP(JointAllocation){};

TEST(JointAllocation, StaysWithinRangesAndGivesTheNearestEffort) {
  CHECK(rc::check("divide", [] {
    const AnyPair pair;
    const PairPower power = pair.divided();
    RC_ASSERT(within(power.agonist_W, pair.ranges.agonist));
    RC_ASSERT(within(power.antagonist_W, pair.ranges.antagonist));
    const auto& [agonist, antagonist] = pair.ranges;
    const PowerRange possible{agonist.min_W - pair.gain_ratio * antagonist.max_W,
                              agonist.max_W - pair.gain_ratio * antagonist.min_W};
    const double nearest_W = possible.clip(pair.effort_W);
    RC_ASSERT(std::abs(pair.allocation.effort_W(power) - nearest_W) <= 1e-9);
  }));
}

TEST(JointAllocation, SharesTheEffortEquallyWhereBothHaveRoom) {
  const JointAllocation allocation(0.8);
  const JointAllocation::Ranges ranges{{0.0, 4.5}, {0.0, 4.5}};
  const PairPower power = allocation.divide(0.6, 1.0, ranges);
  DOUBLES_EQUAL(1.3, power.agonist_W, rounding_W);
  DOUBLES_EQUAL(0.7 / 0.8, power.antagonist_W, rounding_W);
}

TEST(JointAllocation, TheOtherMuscleMakesUpForALimitedOne) {
  const JointAllocation allocation(1.0);
  const JointAllocation::Ranges ranges{{0.0, 4.5}, {0.0, 2.0}};
  // The antagonist cannot cool any further: the agonist alone turns the joint.
  const PairPower up = allocation.divide(3.0, 1.0, ranges);
  DOUBLES_EQUAL(3.0, up.agonist_W, rounding_W);
  DOUBLES_EQUAL(0.0, up.antagonist_W, rounding_W);
  // The antagonist is at its limit: the agonist co-contracts less.
  const PairPower down = allocation.divide(-1.5, 1.5, ranges);
  DOUBLES_EQUAL(0.5, down.agonist_W, rounding_W);
  DOUBLES_EQUAL(2.0, down.antagonist_W, rounding_W);
}

TEST(JointAllocation, MoreEffortNeverReducesTheAgonistsPower) {
  CHECK(rc::check("monotonic", [] {
    AnyPair pair;
    const PairPower before = pair.divided();
    pair.effort_W += *reals(0.0, 5.0);
    const PairPower after = pair.divided();
    RC_ASSERT(after.agonist_W >= before.agonist_W - rounding_W);
    RC_ASSERT(after.antagonist_W <= before.antagonist_W + rounding_W);
  }));
}

TEST(JointAllocation, AnEffortOfNaNGivesNoPower) {
  const JointAllocation allocation(1.0);
  for (const double effort_W : {NAN, INFINITY, -INFINITY}) {
    const PairPower power = allocation.divide(effort_W, 1.0, {});
    CHECK(std::isnan(power.agonist_W) && std::isnan(power.antagonist_W));
  }
}
