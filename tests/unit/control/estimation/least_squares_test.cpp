// Runs one or two seeds for each figure; least_squares_study.cpp runs many.
#include "supercoil/control/estimation/least_squares.hpp"

#include <CppUTest/TestHarness.h>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/estimation/estimator.hpp"

#include "unit/control/support/noisy_muscle.hpp"

using namespace supercoil::control;
using supercoil::test::Learning;

namespace {

/// Far from the paper's muscle, where the paper's own estimator starts.
LeastSquaresSettings from_far() {
  LeastSquaresSettings settings;
  settings.initial = Theta{0.1, 5.0, 30.0, 20.0};
  return settings;
}

}  // namespace

TEST_GROUP(LeastSquares){};

TEST(LeastSquares, FromRestAllParametersAreWithin5PercentAfter2Seconds) {
  Learning<double> learning(1, from_far());
  CHECK(learning.outside_until(0.05, 6.0) <= 2.0);
}

TEST(LeastSquares, AfterAStiffnessChangeAllAreWithin5PercentIn10Seconds) {
  Learning<double> learning(1);
  learning.muscle.soften_at(100.0);
  learning.run_until(100.0);
  CHECK_FALSE(learning.estimator.changes() > 0);
  CHECK(learning.outside_until(0.05, 120.0) <= 110.0);
  LONGS_EQUAL(1, learning.estimator.changes());
  CHECK(learning.estimator.settled());
}

TEST(LeastSquares, IsNotSettledRightAfterAChange) {
  Learning<double> learning(1);
  learning.muscle.soften_at(95.0);
  learning.run_until(2.9);
  CHECK_FALSE(learning.estimator.settled());
  learning.run_until(95.0);
  CHECK(learning.estimator.settled());
  learning.run_until(96.0);
  CHECK_FALSE(learning.estimator.settled());
  CHECK(learning.estimator.since_change_s() < 1.0);
  CHECK(learning.estimator.standard_deviations().maxCoeff() > 0.05);
}

TEST(LeastSquares, EstimatesAConstantBiasOfThePower) {
  LeastSquaresSettings settings;
  LeastSquaresEstimator<double> estimator(settings, 1e-3);
  supercoil::test::NoisyMuscle muscle(1);
  muscle.run_until(20.0, [&](double position_m, double power_W) {
    estimator.step(position_m / settings.scale.dc_gain_m_per_W, power_W + 0.2);
  });
  DOUBLES_EQUAL(0.2, estimator.parameters()[4], 0.002);
  DOUBLES_EQUAL(1.0, estimator.parameters()[3], 0.002);
}

TEST(LeastSquares, FloatMatchesDoubleWithinATenthOfTheDeviation) {
  Learning<double> exact(1);
  Learning<float> narrow(1);
  for (auto* time : {&exact.muscle, &narrow.muscle})
    time->soften_at(95.0);
  exact.run_until(115.0);
  narrow.run_until(115.0);
  const auto deviations = exact.estimator.standard_deviations();
  const auto apart = (narrow.estimator.parameters() - exact.estimator.parameters()).eval();
  for (int i = 0; i < 5; ++i)
    CHECK(std::abs(apart[i]) < 0.1 * deviations[i]);
}

TEST(LeastSquares, NeverReportsParametersOutsideItsBounds) {
  LeastSquaresSettings settings;
  settings.max_ratio = 0.9;
  Learning<double> learning(1, settings);
  learning.run_until(5.0);
  const auto reported = learning.estimator.parameters().head<4>().eval();
  DOUBLES_EQUAL(0.9, reported.maxCoeff(), 1e-12);
  CHECK(reported.minCoeff() >= settings.min_ratio);
}

TEST(LeastSquares, FloatLearnsOverHoursOfMotionAndRest) {
  constexpr double step_s = 1e-2;
  constexpr double hour_s = 3600.0;
  LeastSquaresSettings settings;
  LeastSquaresEstimator<float> estimator(settings, step_s);
  supercoil::test::Muscle muscle(PhysicalParameters{}, step_s);
  const auto worst = [&] {
    return (estimator.parameters().head<4>().array() - 1.0).abs().maxCoeff();
  };
  const auto run = [&](double duration_s, bool moves) {
    for (long k = 0; k < std::lround(duration_s / step_s); ++k) {
      const double power_W =
          moves ? supercoil::test::paper_power_W(step_s * static_cast<double>(k)) : 0.0;
      muscle.step(power_W);
      estimator.step(static_cast<float>(muscle.position_m() / settings.scale.dc_gain_m_per_W),
                     static_cast<float>(power_W));
    }
  };
  run(hour_s, true);
  CHECK(worst() < 0.01);
  CHECK(estimator.standard_deviations().allFinite());
  // Without a bound the covariance would reach e^120 by then.
  run(hour_s, false);
  CHECK(estimator.parameters().allFinite());
  run(60.0, true);
  CHECK(worst() < 0.01);
}

TEST(LeastSquares, ARestartKeepsWhatWasLearned) {
  Learning<double> learning(1);
  learning.run_until(30.0);
  learning.estimator.restart();  // while the muscle is hot and moves
  CHECK(learning.outside_until(0.05, 45.0) <= 30.0);
  LONGS_EQUAL(0, learning.estimator.changes());
}

TEST(LeastSquares, TrustDependsOnTheStandardDeviations) {
  EstimatorSettings settings;
  settings.kind = EstimatorKind::least_squares;
  Estimator estimator(settings, 1e-3);
  CHECK_FALSE(estimator.estimate()->trusted);
  supercoil::test::NoisyMuscle muscle(1);
  const auto see = [&](double position_m, double power_W) { estimator.step(position_m, power_W); };
  muscle.run_until(1.0, see);
  CHECK_FALSE(estimator.estimate()->trusted);
  muscle.run_until(40.0, see);
  const auto estimate = *estimator.estimate();
  CHECK(estimate.trusted);
  CHECK(estimate.settled);
  CHECK(estimate.relative_error_bound < 0.05);
  const Theta off = estimate.theta - theta_from(PhysicalParameters{});
  CHECK((off.cwiseAbs().array() < 5.0 * estimate.deviation.array()).all());
}

/// Its deviations grow only within seconds, and in the first 90 s no change is detected.
TEST(LeastSquares, IsNotTrustedFromTheFirstMomentsOfAChange) {
  EstimatorSettings settings;
  settings.kind = EstimatorKind::least_squares;
  Estimator estimator(settings, 1e-3);
  supercoil::test::NoisyMuscle muscle(1);
  muscle.soften_at(60.0);
  const auto see = [&](double position_m, double power_W) { estimator.step(position_m, power_W); };
  muscle.run_until(60.0, see);
  CHECK(estimator.estimate()->trusted);
  const auto error = [&] {
    const Theta truth = theta_from(muscle.truth());
    return (estimator.estimate()->theta - truth).cwiseQuotient(truth).norm();
  };
  double worst = 0.0;
  for (int tenth = 602; tenth < 750; ++tenth) {
    muscle.run_until(0.1 * tenth, see);
    worst = std::fmax(worst, error());
    if (estimator.estimate()->trusted) CHECK_COMPARE(error(), <, 0.4);
  }
  CHECK_COMPARE(worst, >, 1.0);
}

/// Meanwhile the muscle may have changed.
TEST(LeastSquares, IsNotTrustedRightAfterAPause) {
  EstimatorSettings settings;
  settings.kind = EstimatorKind::least_squares;
  Estimator estimator(settings, 1e-3);
  supercoil::test::NoisyMuscle muscle(1);
  const auto see = [&](double position_m, double power_W) { estimator.step(position_m, power_W); };
  muscle.run_until(40.0, see);
  CHECK(estimator.estimate()->trusted);
  estimator.restart();
  CHECK_FALSE(estimator.estimate()->trusted);
  muscle.run_until(42.9, see);
  CHECK_FALSE(estimator.estimate()->trusted);
  muscle.run_until(60.0, see);
  CHECK(estimator.estimate()->trusted);
}

TEST(LeastSquares, LearnsAtTheSlowestAndFastestLoopRates) {
  for (const double step_s : {1e-2, 1e-4}) {
    LeastSquaresSettings settings;
    LeastSquaresEstimator<double> estimator(settings, step_s);
    supercoil::test::Muscle muscle(PhysicalParameters{}, step_s);
    for (long k = 0; k < std::lround(20.0 / step_s); ++k) {
      const double power_W = supercoil::test::paper_power_W(step_s * static_cast<double>(k));
      muscle.step(power_W);
      estimator.step(muscle.position_m() / settings.scale.dc_gain_m_per_W, power_W);
    }
    CHECK((estimator.parameters().head<4>().array() - 1.0).abs().maxCoeff() < 0.02);
  }
}

TEST(LeastSquares, FixedPointIsNotSupported) {
  CHECK_FALSE(supported(EstimatorKind::least_squares, Arithmetic::q8_24));
  CHECK(supported(EstimatorKind::least_squares, Arithmetic::float32));
  CHECK(supported(EstimatorKind::gradient, Arithmetic::q8_24));
}
