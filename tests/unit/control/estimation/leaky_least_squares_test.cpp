// Recursive least squares with a leak towards its prior, against the sum that it minimises.
#include "supercoil/control/estimation/leaky_least_squares.hpp"

#include <CppUTest/TestHarness.h>
#include <Eigen/Cholesky>

using namespace supercoil::control;

namespace {

using Three = LeakyLeastSquares<3>;
constexpr double observation_variance = 0.01;

Three::Settings usual() {
  return {.prior = {1.0, 0.0, 0.5}, .deviation = {0.5, 0.3, 2.0}, .forgetting = 0.98};
}

Three::Weights regressors(int k) {
  return {std::sin(0.31 * k), std::cos(0.17 * k), std::sin(0.05 * k)};
}

void solve(Three& least_squares) {
  // In two steps, as over two ticks.
  least_squares.factor(0, 2);
  least_squares.factor(2, 3);
  least_squares.solve();
}

}  // namespace

TEST_GROUP(LeakyLeastSquares){};

TEST(LeakyLeastSquares, MinimisesTheWeightedSumOfResidualsAndPrior) {
  const Three::Settings s = usual();
  Three least_squares(s);
  const Three::Weights truth{0.4, -0.7, 1.2};
  Eigen::Matrix3d information = s.deviation.cwiseProduct(s.deviation).cwiseInverse().asDiagonal();
  Eigen::Vector3d moment = information * s.prior;
  constexpr int count = 120;
  for (int k = 0; k < count; ++k) {
    const Three::Weights psi = regressors(k);
    const double z = truth.dot(psi) + 0.05 * std::cos(3.0 * k);
    least_squares.add(psi, z, observation_variance);
    const double weight = std::pow(s.forgetting, count - 1 - k) / observation_variance;
    information += weight * psi * psi.transpose();
    moment += weight * psi * z;
  }
  solve(least_squares);
  const Eigen::Vector3d expected = information.ldlt().solve(moment);
  CHECK((least_squares.weights() - expected).norm() < 1e-10);
}

TEST(LeakyLeastSquares, UnexcitedWeightsReturnToThePriorWhileOthersLearn) {
  Three least_squares(usual());
  for (int k = 0; k < 200; ++k)
    least_squares.add(regressors(k), 3.0 * regressors(k)[1], observation_variance);
  for (int k = 0; k < 5000; ++k)
    least_squares.add(Three::Weights::Unit(0), 2.0, observation_variance);
  solve(least_squares);
  DOUBLES_EQUAL(2.0, least_squares.weights()[0], 1e-3);
  DOUBLES_EQUAL(0.0, least_squares.weights()[1], 1e-6);
  DOUBLES_EQUAL(0.5, least_squares.weights()[2], 1e-6);
}

TEST(LeakyLeastSquares, AMovedWeightStaysAndIsRelearnedQuickly) {
  Three moved(usual());
  Three still(usual());
  const Three::Weights truth{1.0, -0.7, 1.2};
  for (Three* each : {&moved, &still}) {
    for (int k = 0; k < 2000; ++k)
      each->add(regressors(k), truth.dot(regressors(k)), observation_variance);
    solve(*each);
  }
  const Three::Weights before = moved.weights();
  moved.move(Three::Weights::Unit(1), 0.5);
  CHECK((moved.weights() - before - 0.5 * Three::Weights::Unit(1)).norm() < 1e-12);
  solve(moved);
  CHECK((moved.weights() - before - 0.5 * Three::Weights::Unit(1)).norm() < 1e-9);
  const Three::Weights changed = truth + 0.8 * Three::Weights::Unit(1);
  for (Three* each : {&moved, &still}) {
    for (int k = 0; k < 10; ++k)
      each->add(regressors(k), changed.dot(regressors(k)), observation_variance);
    solve(*each);
  }
  CHECK(std::abs(moved.weights()[1] - changed[1]) < 0.02);
  CHECK(std::abs(still.weights()[1] - changed[1]) > 0.2);
}
