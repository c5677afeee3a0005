#include "supercoil/control/estimation/estimate_drift.hpp"

#include <CppUTest/TestHarness.h>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>

using namespace supercoil::control;

namespace {

EstimateDrift::Settings settings() {
  return {.update_s = 1.0,
          .lag_s = 8.0,
          .memory_s = 1e4,
          .unexcited = EstimateDrift::Parameters::Constant(100.0)};
}

/// Mean square after independent estimates with this deviation, when the covariance claims 0.01.
double drift_of(double deviation) {
  EstimateDrift drift(settings());
  boost::random::mt19937 source(1);
  boost::random::normal_distribution<double> normal(0.0, deviation);
  const EstimateDrift::Square covariance = EstimateDrift::Square::Identity() * 1e-4;
  for (int k = 0; k < 5000; ++k) {
    EstimateDrift::Parameters theta = EstimateDrift::Parameters::Zero();
    for (int i = 0; i < EstimateDrift::size; ++i)
      theta[i] = normal(source);
    drift.step(theta, covariance);
  }
  return drift.mean_square();
}

}  // namespace

TEST_GROUP(EstimateDrift){};

TEST(EstimateDrift, DriftBetweenTwoEstimatesIsTwiceTheirVariance) {
  DOUBLES_EQUAL(2.0, drift_of(0.01), 0.1);
  DOUBLES_EQUAL(200.0, drift_of(0.1), 10.0);
}

TEST(EstimateDrift, IsZeroBeforeTheLagAndAfterAChange) {
  EstimateDrift drift(settings());
  const EstimateDrift::Square covariance = EstimateDrift::Square::Identity() * 1e-4;
  for (int k = 0; k < 8; ++k)
    drift.step(EstimateDrift::Parameters::Constant(k), covariance);
  DOUBLES_EQUAL(0.0, drift.mean_square(), 0.0);
  drift.forget_past();
  for (int k = 0; k < 8; ++k)
    drift.step(EstimateDrift::Parameters::Constant(k), covariance);
  DOUBLES_EQUAL(0.0, drift.mean_square(), 0.0);
  drift.step(EstimateDrift::Parameters::Constant(8.0), covariance);
  CHECK(drift.mean_square() > 1.0);
}

TEST(EstimateDrift, UncertainParametersHaveNoWeight) {
  EstimateDrift drift(settings());
  EstimateDrift::Square covariance = EstimateDrift::Square::Identity() * 100.0;
  covariance(0, 0) = 1e-4;
  for (int k = 0; k < 100; ++k) {
    EstimateDrift::Parameters theta = EstimateDrift::Parameters::Zero();
    theta[0] = k % 2 == 0 ? 0.01 : 0.0;
    theta[1] = 0.1 * k;
    drift.step(theta, covariance);
  }
  // Every eighth step is compared: θ1 has not moved; θ2 has by 0.8, with a deviation of 10.
  CHECK(drift.mean_square() < 0.01);
}
