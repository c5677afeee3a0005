#include "supercoil/control/estimation/parametric_model.hpp"

#include <random>

#include <CppUTest/TestHarness.h>

#include "supercoil/control/actuator/conversions.hpp"

#include "unit/control/support/muscle.hpp"

using namespace supercoil::control;
using supercoil::test::Muscle;

namespace {

/// The scale in which this muscle's true θ is exactly [1 1 1 1].
RegressionScale scale_of(const PhysicalParameters& p) {
  return {theta_from(p), p.dc_gain_m_per_W(), p.moving_mass_kg};
}

/// The largest |z − θ*ᵀφ| in 20 s of random power levels, each held for half a second.
double max_residual(const PhysicalParameters& p, double step_s) {
  const RegressionScale scale = scale_of(p);
  Muscle muscle(p, step_s);
  ParametricModel<double> model(paper_lambda, scale, step_s);
  std::mt19937_64 random(7);
  const long hold = std::lround(0.5 / step_s);
  double power_W = 0.0;
  double worst = 0.0;
  for (long k = 0; k < 40 * hold; ++k) {
    if (k % hold == 0) power_W = 4.5 * static_cast<double>(random() % 1000) / 999.0;
    muscle.step(power_W);
    model.step(muscle.position_m() / scale.dc_gain_m_per_W, power_W);
    worst = std::fmax(worst, std::abs(model.z() - model.phi().sum()));
  }
  return worst;
}

constexpr PhysicalParameters slow_muscle{0.5, 0.1, 4.0, 0.3, 0.2, 0.02};

}  // namespace

TEST_GROUP(ParametricModel){};

TEST(ParametricModel, TrueParametersExplainThePowerWithoutNoise) {
  CHECK(max_residual(PhysicalParameters{}, 1e-3) < 2e-7);
  CHECK(max_residual(slow_muscle, 1e-3) < 2e-7);
}

TEST(ParametricModel, ResidualFallsWithTheSquareOfTheStep) {
  const double coarse = max_residual(PhysicalParameters{}, 10e-3);
  const double fine = max_residual(PhysicalParameters{}, 5e-3);
  CHECK(coarse > 1e-7);
  DOUBLES_EQUAL(4.0, coarse / fine, 0.3);
}

TEST(ParametricModel, AWrongParameterLeavesAResidual) {
  PhysicalParameters wrong;
  wrong.stiffness_N_per_m *= 1.1;
  const RegressionScale scale = scale_of(wrong);
  Muscle muscle(PhysicalParameters{}, 1e-3);
  ParametricModel<double> model(paper_lambda, scale, 1e-3);
  for (int k = 0; k < 20000; ++k) {
    muscle.step(2.0);
    model.step(muscle.position_m() / scale.dc_gain_m_per_W, 2.0);
  }
  // At rest θ4 x = P: 10 % too much stiffness explains 10 % too much power, through 1/Λ(0) = 0.1.
  DOUBLES_EQUAL(-0.02, model.z() - model.phi().sum(), 1e-4);
}
