// Deviations that hold when the model is not exact.
#include "supercoil/identification/deviations.hpp"

#include <array>
#include <cmath>
#include <random>

#include <CppUTest/TestHarness.h>

#include "unit/identification/support/simulated.hpp"

namespace {

using namespace supercoil::identification;
using namespace supercoil::identification::test;

/// A muscle with one effect that a linear model lacks.
Muscle random_muscle(std::size_t effect, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto between = [&](double low, double high) {
    return low * std::pow(high / low, unit(random));
  };
  Muscle m;
  m.gain_m_per_W = between(0.003, 0.012);
  m.time_constant_s = between(2.0, 12.0);
  m.natural_frequency_rad_per_s = between(6.0, 30.0);
  m.damping_ratio = between(0.2, 1.6);
  if (effect == 0) m.drift_m_per_s = 3e-5 * unit(random);
  if (effect == 1) m.force_ratio = 1.0 + 2.0 * unit(random);
  if (effect == 2) m.transfer_ratio = 1.0 + unit(random);
  if (effect == 3) {
    m.play_ratio = 0.1 + 0.4 * unit(random);
    m.play_range_W = 0.5 + unit(random);
  }
  if (effect == 4) {
    m.creep_ratio = 0.1 + 0.2 * unit(random);
    m.creep_s = 10.0 + 40.0 * unit(random);
  }
  return m;
}

}  // namespace

TEST_GROUP(Deviations){};

TEST(Deviations, CoverTheFitOfTheNextMinute) {
  std::mt19937 random(7);
  int within = 0;
  int within_half = 0;
  constexpr int muscles = 30;
  for (unsigned i = 0; i < muscles; ++i) {
    Samples samples = random_steps(120.0, full_W, i);
    record(random_muscle(i % 5, random), noise_m, i + 1000, samples);
    const Fit first = fit_model({}, samples, {0.0, 60.0});
    const Fit second = refit(first.muscle, {}, samples, {60.0, 120.0});
    for (const std::size_t p : {std::size_t{0}, std::size_t{1}}) {
      const auto member = first.parameters[p].member;
      const double apart = std::abs(first.muscle.*member - second.muscle.*member);
      const double deviation = std::hypot(first.deviation(p), second.deviation(p));
      within += apart <= 2.0 * deviation ? 1 : 0;
      within_half += apart <= deviation ? 1 : 0;
    }
  }
  // Gain and time constant of each: in a normal distribution 95 % are within two deviations.
  CHECK(within >= 54);
  // They are not simply wide.
  CHECK(within_half <= 55);
}

TEST(Deviations, CountCorrelatedSamplesOnce) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0.0, 1.0);
  Eigen::VectorXd white(20000);
  Eigen::VectorXd filtered(20000);
  double state = 0.0;
  for (Eigen::Index i = 0; i < white.size(); ++i) {
    white[i] = normal(random);
    filtered[i] = state = 0.9 * state + white[i];
  }
  DOUBLES_EQUAL(1.0, correlated_samples(white), 0.05);
  // (1 + 0.9)/(1 − 0.9), minus the part below the limit of 0.05.
  DOUBLES_EQUAL(18.0, correlated_samples(filtered), 2.0);
}

TEST(Deviations, ForWhiteNoiseAreThoseOfLeastSquares) {
  // A mean of 5,000 values of variance 4: 2/√5000, plus twice the jackknife's variance of it.
  std::mt19937 random(2);
  std::normal_distribution<double> normal(0.0, 2.0);
  Eigen::VectorXd residual(5000);
  for (double& value : residual)
    value = normal(random);
  residual.array() -= residual.mean();
  const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(5000, 1);
  const Eigen::VectorXd at_best = Eigen::VectorXd::Zero(1);
  const Eigen::VectorXd wide = Eigen::VectorXd::Constant(1, 100.0);
  const Accuracy accuracy = accuracy_of(ones, residual, at_best, wide);
  const double min_deviation = 2.0 / std::sqrt(5000.0);
  const double deviation = std::sqrt(accuracy.covariance(0, 0));
  CHECK(deviation > 0.95 * min_deviation && deviation < 2.5 * min_deviation);
  DOUBLES_EQUAL(2.0, accuracy.cross_validated, 0.05);
}

TEST(Deviations, OfUndeterminedParametersAreThePriors) {
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(500, 2);
  jacobian.col(0).setOnes();
  const Eigen::VectorXd residual = Eigen::VectorXd::LinSpaced(500, -1.0, 1.0);
  const Accuracy accuracy =
      accuracy_of(jacobian, residual, Eigen::VectorXd::Zero(2), Eigen::VectorXd::Constant(2, 0.8));
  DOUBLES_EQUAL(0.8, std::sqrt(accuracy.covariance(1, 1)), 1e-9);
}
