// Adaptive feedforward with least squares, closed over the paper's muscle with a noisy sensor.
#include "supercoil/control/tracking/adaptive_feedforward.hpp"

#include <CppUTest/TestHarness.h>

#include "unit/control/support/noisy_loop.hpp"

using namespace supercoil::control;
using supercoil::test::NoisyLoop;

namespace {

/// initial_ratio: the parameters with which estimator and feedforward start, over the true θ.
NoisyLoop feedforward_loop(double initial_ratio = 1.0) {
  NoisyLoop loop;
  loop.controller.kind = ControllerKind::adaptive_ff;
  loop.controller.model = design_model();
  EstimatorSettings estimator;
  estimator.kind = EstimatorKind::least_squares;
  estimator.least_squares.initial *= initial_ratio;
  loop.estimator = estimator;
  loop.believed = {.theta = estimator.least_squares.initial, .settled = true};
  return loop;
}

}  // namespace

TEST_GROUP(AdaptiveFeedforward){};

TEST(AdaptiveFeedforward, FollowsTheSineWithin1Micrometre2BeforeAndAfterAChange) {
  NoisyLoop loop = feedforward_loop();
  loop.soft_from_s = 50.0;
  const auto um = loop.rms_um<3>({{{25.0, 50.0}, {50.0, 60.0}, {110.0, 130.0}}});
  UT_PRINT(
      StringFromFormat("um: %.2f, change %.0f, then %.2f rms", um[0], um[1], um[2]).asCharString());
  CHECK(um[0] <= 1.2);
  CHECK(um[1] <= 200.0);
  CHECK(um[2] <= 3.0);
}

TEST(AdaptiveFeedforward, FollowsStepsWithin1Micrometre2) {
  NoisyLoop loop = feedforward_loop();
  loop.reference_m = supercoil::test::paper_steps_m;
  const auto um = loop.rms_um<1>({{{60.0, 100.0}}});
  UT_PRINT(StringFromFormat("um: %.2f rms", um[0]).asCharString());
  CHECK(um[0] <= 1.2);
}

TEST(AdaptiveFeedforward, StartsFrom55PercentOfTheTrueParameters) {
  const auto um = feedforward_loop(0.55).rms_um<3>({{{0.0, 3.0}, {3.0, 10.0}, {10.0, 20.0}}});
  UT_PRINT(StringFromFormat("um: %.0f, %.0f, %.1f rms", um[0], um[1], um[2]).asCharString());
  CHECK(um[2] <= 5.0);
}

TEST(AdaptiveFeedforward, FloatAndFixedPointFollowEquallyWell) {
  NoisyLoop loop = feedforward_loop();
  for (const Arithmetic arithmetic : {Arithmetic::float32, Arithmetic::q8_24}) {
    loop.controller.arithmetic = arithmetic;
    CHECK(loop.rms_um<1>({{{25.0, 40.0}}})[0] <= 2.0);
  }
}

TEST(AdaptiveFeedforward, DoesNotFollowAnEstimateThatHasNotSettled) {
  AdaptiveFeedforward<double> law({}, 1e-3);
  Estimate estimate{.theta = RegressionScale{}.nominal * 3.0, .bias_W = 1.0};
  law.learn(estimate);
  CHECK((law.theta() - AdaptiveFeedforward<double>::Parameters{1.0, 1.0, 1.0, 1.0, 0.0}).norm() ==
        0);
  estimate.settled = true;
  const long ticks = std::lround(AdaptiveFeedforwardSettings{}.follow_s / 1e-3);
  for (long k = 0; k < ticks; ++k)
    law.learn(estimate);
  DOUBLES_EQUAL(3.0 - 2.0 * std::exp(-1.0), law.theta()[0], 1e-3);
  DOUBLES_EQUAL(1.0 - std::exp(-1.0), law.theta()[4], 1e-3);
}

TEST(AdaptiveFeedforward, LearningDoesNotChangeThePower) {
  AdaptiveFeedforward<double> law({}, 1e-3);
  LawInput<double> moving;
  moving.model = {1.5, 0.4, -0.1};
  moving.model_jerk = 0.2;
  moving.position = moving.model.position;
  LawStart<double> begin;
  begin.position = moving.position;
  begin.model = moving.model;
  law.start(begin);
  const double before_W = law.step(moving);
  const Estimate estimate{.theta = RegressionScale{}.nominal * 1.3, .settled = true, .bias_W = 0.2};
  for (int k = 0; k < 5000; ++k)
    law.learn(estimate);
  DOUBLES_EQUAL(1.3, law.theta()[3], 1e-4);
  DOUBLES_EQUAL(before_W, law.step(moving), 1e-9);
}

TEST(AdaptiveFeedforward, HoldsItsIntegralAtTheLimitAndLetsItOnlyLeadOut) {
  AdaptiveFeedforward<double> law({}, 1e-3);
  const auto start = [&](double error_W, double power_W) {
    LawStart<double> at;
    at.model.position = error_W;
    at.power = power_W;
    law.start(at);
  };
  const auto step = [&](double error_W) {
    LawInput<double> in;
    in.model.position = error_W;
    in.applied = 4.5;
    in.limited = true;
    return law.step(in);
  };
  start(1.0, 99.0);
  const double held = step(1.0);
  for (int k = 0; k < 1000; ++k)  // above the upper limit, pushing further
    DOUBLES_EQUAL(held, step(1.0), 1e-12);
  start(-1.0, 99.0);  // still above, but the error leads out
  const double first = step(-1.0);
  start(-1.0, -99.0);  // below, pushing further
  const double pushed = step(-1.0);
  DOUBLES_EQUAL(8.0 * RegressionScale{}.nominal[3] * RegressionScale{}.dc_gain_m_per_W * 1e-3,
                pushed - first, 1e-12);
}
