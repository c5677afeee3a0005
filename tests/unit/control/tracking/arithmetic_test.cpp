// Every law and the estimator in float and q8.24 against double, in closed loop on the muscle.
#include <CppUTest/TestHarness.h>

#include "supercoil/control/estimation/estimator.hpp"
#include "supercoil/control/tracking/controller.hpp"

#include "unit/control/support/muscle.hpp"

using namespace supercoil::control;

namespace {

std::vector<double> positions(ControllerSettings settings, Arithmetic arithmetic) {
  settings.arithmetic = arithmetic;
  Controller controller(settings, 1e-3);
  std::vector<double> result;
  supercoil::test::run_closed_loop(
      controller, 1e-3, 60.0, PowerRange{}, supercoil::test::paper_sine_m,
      [&](const supercoil::test::Tick& tick) { result.push_back(tick.position_m); });
  return result;
}

/// The largest distance in metres between the motions of two arithmetics.
double distance(const ControllerSettings& settings, Arithmetic arithmetic) {
  const auto exact = positions(settings, Arithmetic::float64);
  const auto other = positions(settings, arithmetic);
  double worst = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i)
    worst = std::fmax(worst, std::abs(exact[i] - other[i]));
  return worst;
}

ControllerSettings mrac(const MracSettings& settings) {
  ControllerSettings result;
  result.mrac = settings;
  return result;
}

void expect_close(const ControllerSettings& settings) {
  CHECK(distance(settings, Arithmetic::q8_24) < 1e-6);
  CHECK(distance(settings, Arithmetic::float32) < 1e-6);
}

}  // namespace

TEST_GROUP(Arithmetics){};

TEST(Arithmetics, PrintedMracFollowsDoubleWithinAMicrometre) {
  expect_close(mrac(MracSettings{}.scaled(10.0)));
}

TEST(Arithmetics, DesignAFollowsDoubleWithinAMicrometre) {
  expect_close(mrac(*mrac_preset("a")));
}

TEST(Arithmetics, PiFollowsDoubleWithinAMicrometre) {
  ControllerSettings settings;
  settings.kind = ControllerKind::pi;
  settings.model = design_model();
  expect_close(settings);
}

TEST(Arithmetics, PdWithFeedforwardFollowsDoubleWithinAMicrometre) {
  ControllerSettings settings;
  settings.kind = ControllerKind::pd_ff;
  settings.model = design_model();
  expect_close(settings);
}

TEST(Arithmetics, GradientEstimatesFollowDoubleWithinAThousandth) {
  const auto theta = [](Arithmetic arithmetic) {
    EstimatorSettings settings;
    settings.arithmetic = arithmetic;
    Estimator estimator(settings, 1e-3);
    supercoil::test::Muscle muscle(PhysicalParameters{}, 1e-3);
    for (int k = 0; k < 60000; ++k) {
      const double power_W = supercoil::test::paper_power_W(1e-3 * k);
      muscle.step(power_W);
      estimator.step(muscle.position_m(), power_W);
    }
    return estimator.estimate()->theta;
  };
  const Theta exact = theta(Arithmetic::float64);
  for (const Arithmetic other : {Arithmetic::q8_24, Arithmetic::float32}) {
    const Theta off = theta(other).cwiseQuotient(exact) - Theta::Ones();
    CHECK(off.cwiseAbs().maxCoeff() < 1e-3);
  }
}
