// MRAC by least squares: its parameters against the matching equation, and its tracking.
#include "supercoil/control/tracking/mrac_least_squares.hpp"

#include <CppUTest/TestHarness.h>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/tracking/controller.hpp"

#include "unit/control/support/noisy_loop.hpp"

using namespace supercoil::control;
using supercoil::test::NoisyLoop;

namespace {

ControllerSettings least_squares_mrac() {
  ControllerSettings settings;
  settings.kind = ControllerKind::mrac_ls;
  return settings;
}

double rich_m(double time_s) {
  return 0.011 + 0.003 * std::sin(0.25 * time_s) + 0.002 * std::sin(0.7 * time_s) +
         0.001 * (std::sin(1.3 * time_s) + std::sin(2.9 * time_s) + std::sin(4.7 * time_s));
}

}  // namespace

TEST_GROUP(MracLeastSquares){};

TEST(MracLeastSquares, FindsTheParametersOfTheMatchingEquation) {
  // A muscle other than the nominal one, without noise: θ must become its own θ*.
  PhysicalParameters truth;
  truth.stiffness_N_per_m = 14.0;
  truth.heat_transfer_W_per_K = 0.1;
  const double step_s = 1e-3;
  MracLeastSquaresSettings settings;
  settings.noise_W2 = 1e-10;  // so that the prior has no weight
  MracLeastSquares<double> law(settings, wm16_model(), step_s);
  ReferenceModel<double> model(wm16_model(), step_s);
  supercoil::test::Muscle muscle(truth, step_s);
  const double to_watts = 1.0 / settings.scale.dc_gain_m_per_W;
  LawInput<double> in;
  double power_W = 0.0;
  for (long k = 0; k < 300'000; ++k) {
    model.step(in.reference);
    in.reference = rich_m(static_cast<double>(k) * step_s) * to_watts;
    in.position = muscle.position_m() * to_watts;
    in.model = model.motion();
    in.applied = power_W;
    power_W = law.step(in);
    muscle.step(power_W);
  }
  MracLeastSquaresSettings of_truth = settings;
  of_truth.scale.nominal = theta_from(truth);
  auto expected = match(of_truth, wm16_model())->theta;
  // match() has position in watts at rest of its own muscle, the law in watts of the nominal one.
  const double scale = truth.dc_gain_m_per_W() / settings.scale.dc_gain_m_per_W;
  expected.tail<4>() /= scale;
  const auto theta = law.theta();
  for (int i = 0; i < 6; ++i)
    DOUBLES_EQUAL(expected[i], theta[i], 1e-3 * std::abs(expected[i]));
  DOUBLES_EQUAL(0.0, theta[6], 1e-3);
}

TEST(MracLeastSquares, FollowsTheSineWithin5MicrometresBeforeAndAfterAChange) {
  NoisyLoop loop{.controller = least_squares_mrac(), .soft_from_s = 100.0};
  const auto um = loop.rms_um<3>({{{60.0, 100.0}, {100.0, 110.0}, {160.0, 200.0}}});
  UT_PRINT(
      StringFromFormat("um: %.2f, change %.0f, then %.2f rms", um[0], um[1], um[2]).asCharString());
  CHECK(um[0] <= 5.0);
  CHECK(um[1] <= 400.0);
  CHECK(um[2] <= 15.0);
}

TEST(MracLeastSquares, FollowsStepsWithin15MicrometresAnd20AfterAChange) {
  NoisyLoop loop{.controller = least_squares_mrac(),
                 .soft_from_s = 100.0,
                 .reference_m = supercoil::test::paper_steps_m};
  const auto um = loop.rms_um<2>({{{60.0, 100.0}, {160.0, 200.0}}});
  UT_PRINT(StringFromFormat("um: %.2f, after the change %.2f rms", um[0], um[1]).asCharString());
  CHECK(um[0] <= 15.0);
  CHECK(um[1] <= 20.0);
}

TEST(MracLeastSquares, FloatFollowsEquallyWell) {
  NoisyLoop loop{.controller = least_squares_mrac()};
  loop.controller.arithmetic = Arithmetic::float32;
  CHECK(loop.rms_um<1>({{{30.0, 60.0}}})[0] <= 5.0);
}

TEST(MracLeastSquares, DoesNotSupportFixedPoint) {
  CHECK_FALSE(supported(ControllerKind::mrac_ls, Arithmetic::q8_24));
  CHECK(supported(ControllerKind::mrac_ls, Arithmetic::float32));
}
