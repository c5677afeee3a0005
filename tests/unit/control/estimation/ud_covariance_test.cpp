#include "supercoil/control/estimation/ud_covariance.hpp"

#include <CppUTest/TestHarness.h>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>

using namespace supercoil::control;

namespace {

/// Regressors of four parameters, nearly in one plane, which makes covariances ill-conditioned.
class Regressors {
 public:
  Vector<double, 4> next() {
    const double a = normal_(source_);
    const double b = normal_(source_);
    return {a, b, a + b + 1e-3 * normal_(source_), a - b + 1e-3 * normal_(source_)};
  }

 private:
  boost::random::mt19937 source_{1};
  boost::random::normal_distribution<double> normal_;
};

}  // namespace

TEST_GROUP(UdCovariance){};

TEST(UdCovariance, MatchesTheTextbookCovarianceAndGain) {
  Regressors regressors;
  Matrix<double, 4> expected = Matrix<double, 4>::Identity() * 100.0;
  UdCovariance<double, 4> covariance(Vector<double, 4>::Constant(100.0));
  for (int k = 0; k < 50; ++k) {
    const Vector<double, 4> phi = regressors.next();
    const Vector<double, 4> gain = expected * phi / (0.9 * 0.1 + phi.dot(expected * phi));
    CHECK((covariance.update(phi, 0.1, 0.9, 0) - gain).norm() < 1e-9 * gain.norm());
    expected = (expected - gain * (phi.transpose() * expected)).eval() / 0.9;
    CHECK((covariance.matrix() - expected).norm() < 1e-6 * expected.norm());
  }
  const double largest = expected.diagonal().maxCoeff();
  DOUBLES_EQUAL(largest, covariance.max_variance(0), 1e-6 * largest);
}

TEST(UdCovariance, StaysPositiveInFloatWhereTheTextbookUpdateDoesNot) {
  Regressors regressors;
  Matrix<float, 4> textbook = Matrix<float, 4>::Identity() * 100.0F;
  UdCovariance<float, 4> covariance(Vector<float, 4>::Constant(100.0F));
  float lowest = 1.0F;
  float min_of_textbook = 1.0F;
  for (int k = 0; k < 20'000; ++k) {
    const Vector<float, 4> phi = regressors.next().cast<float>();
    covariance.update(phi, 1e-7F, 0.9997F, 0);
    lowest = std::fmin(lowest, covariance.matrix().diagonal().minCoeff());
    const Vector<float, 4> along = textbook * phi;
    textbook = ((textbook - along * along.transpose() / (1e-7F + phi.dot(along))) / 0.9997F).eval();
    min_of_textbook = std::fmin(min_of_textbook, textbook.diagonal().minCoeff());
  }
  CHECK(lowest > 0.0F);
  CHECK_FALSE(min_of_textbook > 0.0F);
}

TEST(UdCovariance, AKnownParameterDoesNotMove) {
  Regressors regressors;
  UdCovariance<double, 4> covariance(Vector<double, 4>{0.0, 1.0, 2.0, 3.0});
  for (int k = 0; k < 20; ++k)
    DOUBLES_EQUAL(0.0, covariance.update(regressors.next(), 0.1, 1.0, 0)[0], 0.0);
}

TEST(UdCovariance, RenewingTheFirstParametersKeepsTheRemainingBlock) {
  Regressors regressors;
  UdCovariance<double, 4> covariance(Vector<double, 4>::Constant(100.0));
  for (int k = 0; k < 20; ++k)
    covariance.update(regressors.next(), 0.1, 1.0, 0);
  const Matrix<double, 4> before = covariance.matrix();
  covariance.renew_first<2>(Vector<double, 2>{5.0, 7.0});
  Matrix<double, 4> expected = Matrix<double, 4>::Zero();
  expected(0, 0) = 5.0;
  expected(1, 1) = 7.0;
  expected.bottomRightCorner<2, 2>() = before.bottomRightCorner<2, 2>();
  CHECK((covariance.matrix() - expected).norm() < 1e-12);
}

TEST(UdCovariance, InflatingAddsToVariancesOnly) {
  Regressors regressors;
  UdCovariance<double, 4> covariance(Vector<double, 4>{0.0, 100.0, 100.0, 100.0});
  for (int k = 0; k < 20; ++k)
    covariance.update(regressors.next(), 0.1, 1.0, 0);
  const Matrix<double, 4> expected = covariance.matrix() + 0.1 * Matrix<double, 4>::Identity();
  covariance.inflate(0.1);
  CHECK((covariance.matrix() - expected).norm() < 1e-12);
}

TEST(UdCovariance, AddingADirectionGrowsOnlyThatDirection) {
  Regressors regressors;
  UdCovariance<double, 4> covariance(Vector<double, 4>::Constant(100.0));
  for (int k = 0; k < 20; ++k)
    covariance.update(regressors.next(), 0.1, 1.0, 0);
  const Vector<double, 4> direction{0.0, 0.0, 1.0, 2.0};
  const Matrix<double, 4> more = direction * direction.transpose();
  const Matrix<double, 4> expected = covariance.matrix() + more;
  covariance.add(more);
  CHECK((covariance.matrix() - expected).norm() < 1e-12);
}
