// A reference is shaped so that the model moves only as the muscle can.
#include "supercoil/control/tracking/reference_shaper.hpp"

#include <CppUTest/TestHarness.h>

#include "unit/control/support/noisy_loop.hpp"

using namespace supercoil::control;
using supercoil::test::NoisyLoop;

namespace {

constexpr double tick_s = 1e-3;
constexpr double level_m = 0.020;

/// A model that follows shaped references.
struct Shaped {
  ReferenceModelSettings settings = design_model();
  ReferenceShaper shaper{settings, RegressionScale{}};
  ReferenceModel<double> model{settings, tick_s};
  FeasibleReference now{};

  void at_rest(double position_m) { model.set({position_m, 0.0, 0.0}); }
  void tick(double reference_m, const PowerRange& range = {}) {
    now = shaper.step(reference_m, model.motion(), range);
    model.step(now.reference_m);
  }
  double position_m() const { return model.motion().position; }
};

double fall_um(const std::array<double, 2>& span_s, bool is_shaped) {
  NoisyLoop loop;
  loop.controller.kind = ControllerKind::adaptive_ff;
  loop.controller.model = poles_model({3.0, 3.0, 3.0});
  if (is_shaped) loop.controller.shape_reference = true;
  loop.reference_m = [](double time_s) { return time_s < 20.0 ? level_m : 0.002; };
  return loop.rms_um<1>({span_s})[0];
}

}  // namespace

TEST_GROUP(ReferenceShapers){};

TEST(ReferenceShapers, FeasibleReferencePassesToTheBit) {
  Shaped shaped;
  ReferenceModel<double> plain(shaped.settings, tick_s);
  for (int k = 0; k < 60'000; ++k) {
    const double reference_m = supercoil::test::paper_sine_m(k * tick_s);
    shaped.tick(reference_m);
    plain.step(reference_m);
    CHECK(shaped.now.infeasible == Infeasible::nothing);
    CHECK(shaped.now.reference_m == reference_m);
  }
  CHECK(shaped.position_m() == plain.motion().position);
}

TEST(ReferenceShapers, FallIsTheCoolingMuscleItself) {
  Shaped shaped;
  shaped.at_rest(level_m);
  supercoil::test::Muscle muscle(PhysicalParameters{}, tick_s);
  const double holds_W = level_m / PhysicalParameters{}.dc_gain_m_per_W();
  for (int k = 0; k < 60'000; ++k)
    muscle.step(holds_W);
  DOUBLES_EQUAL(level_m, muscle.position_m(), 1e-9);
  int cooling = 0;
  // Not a realistic reference: it asks for more than the muscle can do from the first tick on.
  for (int k = 0; k < 3'000; ++k) {
    shaped.tick(-10.0);
    muscle.step(0.0);
    cooling += static_cast<int>(shaped.now.infeasible == Infeasible::cooling);
    DOUBLES_EQUAL(muscle.position_m(), shaped.position_m(), 20e-6);
  }
  LONGS_EQUAL(3'000, cooling);
}

TEST(ReferenceShapers, ArrivesAndIsNoLongerLimited) {
  Shaped shaped;
  shaped.at_rest(level_m);
  double min_m = level_m;
  for (int k = 0; k < 30'000; ++k) {
    shaped.tick(0.002);
    min_m = std::fmin(min_m, shaped.position_m());
  }
  CHECK(shaped.now.infeasible == Infeasible::nothing);
  DOUBLES_EQUAL(0.002, shaped.position_m(), 1e-6);
  // Hardly more than the model's own overshoot, 5 %.
  CHECK(min_m > 0.002 - 0.08 * (level_m - 0.002));
}

TEST(ReferenceShapers, MaxPowerSetsTheHighestPosition) {
  Shaped shaped;
  const PowerRange weak{0.0, 2.0};
  bool was_limited = false;
  for (int k = 0; k < 60'000; ++k) {
    shaped.tick(0.025, weak);
    was_limited = was_limited || shaped.now.infeasible == Infeasible::heating;
    CHECK(shaped.shaper.power_W(shaped.now.reference_m, shaped.model.motion()) < 2.0 + 0.02);
  }
  CHECK_TRUE(was_limited);
  DOUBLES_EQUAL(2.0 * PhysicalParameters{}.dc_gain_m_per_W(), shaped.position_m(), 1e-6);
}

TEST(ReferenceShapers, OnlyATrustedEstimateIsUsed) {
  Shaped shaped;
  const ModelMotion<double> rest{level_m, 0.0, 0.0};
  const double by_nominal_W = shaped.shaper.power_W(level_m, rest);
  Estimate estimate;
  estimate.theta = RegressionScale{}.nominal * 2.0;
  estimate.bias_W = 0.1;
  shaped.shaper.learn(estimate);
  CHECK(shaped.shaper.power_W(level_m, rest) == by_nominal_W);
  estimate.trusted = true;
  shaped.shaper.learn(estimate);
  DOUBLES_EQUAL(2.0 * by_nominal_W + 0.1, shaped.shaper.power_W(level_m, rest), 1e-9);
}

TEST(ReferenceShapers, ClosedLoopTracksAShapedFall) {
  const std::array<double, 2> fall_s{20.0, 40.0};
  const double plain_um = fall_um(fall_s, false);
  const double shaped_um = fall_um(fall_s, true);
  UT_PRINT(StringFromFormat("rms of a fall from 20 to 2 mm: %.1f um, shaped %.1f um", plain_um,
                            shaped_um)
               .asCharString());
  CHECK(plain_um > 500.0);
  CHECK(shaped_um < 30.0);
}
