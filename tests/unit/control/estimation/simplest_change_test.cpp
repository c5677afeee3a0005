#include "supercoil/control/estimation/simplest_change.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>

using namespace supercoil::control;

namespace {

using Parameters = SimplestChange::Parameters;
using Square = SimplestChange::Square;

enum Kind : int { stiffness, gain, load, cooling };

/// For a muscle with θ = 1 that is known to 0.1 %.
SimplestChange begun(double cooling_deviation = 1.0) {
  SimplestChange::Directions along = SimplestChange::Directions::Zero();
  along.col(stiffness) << 0.0, 0.0, 1.0, 1.0, 0.0;
  along.col(gain) << 1.0, 1.0, 1.0, 1.0, 0.0;
  along.col(load)[4] = 1.0;
  along.col(cooling)[3] = cooling_deviation;
  Parameters theta = Parameters::Ones();
  theta[4] = 0.0;
  Square all = along * along.transpose();
  all.diagonal().array() += 0.05 * 0.05;
  SimplestChange change;
  change.begin(theta, Square::Identity() * 1e-6, along, all);
  return change;
}

Parameters moved(double theta1, double theta2, double theta3, double theta4, double bias_W) {
  Parameters theta;
  theta << theta1, theta2, theta3, theta4, bias_W;
  return theta;
}

/// The covariance when only the sum of θ4 and the bias is known.
Square sum_known() {
  Parameters open = Parameters::Zero();
  open[3] = 0.3;
  open[4] = -0.3;
  return Square::Identity() * 1e-6 + open * open.transpose();
}

}  // namespace

TEST_GROUP(SimplestChange){};

TEST(SimplestChange, KnownValuesArePassedThrough) {
  const Square known = Square::Identity() * 1e-6;
  for (const Parameters& theta : {moved(1.0, 1.0, 0.75, 0.75, 0.0), moved(1.3, 1.3, 1.3, 1.3, 0.0),
                                  moved(1.0, 1.0, 1.0, 1.0, 0.5), moved(1.0, 1.0, 1.0, 1.4, 0.0)}) {
    const auto found = begun().explained(theta, known);
    CHECK(found.has_value());
    CHECK((*found - theta).norm() < 0.01);
  }
}

TEST(SimplestChange, UndeterminedParametersKeepTheirValues) {
  // The data determine the sum of θ3 and the bias, and that all else is unchanged: this fits a
  // load, but not a softer muscle.
  Square covariance = Square::Identity() * 1e-6;
  Parameters open = Parameters::Zero();
  open[2] = 0.3;
  open[4] = -0.3;
  covariance += open * open.transpose();
  // Least squares lies halfway: it puts half of the change into θ3.
  const auto found = begun().explained(moved(1.0, 1.0, 1.25, 1.0, 0.25), covariance);
  CHECK(found.has_value());
  DOUBLES_EQUAL(1.0, (*found)[2], 0.02);
  DOUBLES_EQUAL(0.5, (*found)[4], 0.03);
}

/// The data determine only the sum of θ4 and the bias.
TEST(SimplestChange, EquallyGoodExplanationsAreLeftUndecided) {
  const SimplestChange change = begun();
  CHECK_FALSE(change.explained(moved(1.0, 1.0, 1.0, 1.25, 0.25), sum_known()).has_value());
  DOUBLES_EQUAL(1.0, change.before()[3], 0.0);
}

TEST(SimplestChange, PrefersTheNarrowerOfTwoEquallyGoodExplanations) {
  const auto found = begun(20.0).explained(moved(1.0, 1.0, 1.0, 1.25, 0.25), sum_known());
  CHECK(found.has_value());
  DOUBLES_EQUAL(1.0, (*found)[3], 0.02);
  DOUBLES_EQUAL(0.5, (*found)[4], 0.03);
}

TEST(SimplestChange, TwoSimultaneousChangesPassThroughFromLeastSquares) {
  const Parameters theta = moved(1.0, 1.0, 0.75, 0.75, 0.5);
  const auto found = begun().explained(theta, Square::Identity() * 1e-6);
  CHECK(found.has_value());
  CHECK((*found - theta).norm() < 1e-9);
}

TEST(SimplestChange, NaNIsLeftUndecided) {
  CHECK_FALSE(begun().explained(Parameters::Constant(NAN), Square::Identity()).has_value());
}
