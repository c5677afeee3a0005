#include <numbers>
#include <random>

#include <CppUTest/TestHarness.h>
#include <Eigen/QR>
#include <rapidcheck.h>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/estimation/estimator.hpp"

#include "unit/control/support/generators.hpp"
#include "unit/control/support/muscle.hpp"

using namespace supercoil::control;
using supercoil::test::Muscle;
using Phi = Vector<double, 4>;

namespace {

constexpr double block_step_s = 1e-2;

/// Sines of 1, 2, 3 and 4 periods in the window of 20 s are orthogonal over it.
Phi orthogonal_sines(long tick, const Phi& amplitude) {
  Phi phi;
  for (int i = 0; i < 4; ++i) {
    const double omega = 2.0 * std::numbers::pi * (i + 1) / 20.0;
    phi[i] = amplitude[i] * std::sin(omega * block_step_s * static_cast<double>(tick));
  }
  return phi;
}

/// The final estimate after the muscle moved under this power, with 10 µm rms of noise.
template <class Power>
Estimate learn(double duration_s, Power power_W, double noise_rms_m, bool* ever_trusted) {
  const double tick_s = 1e-3;
  Estimator estimator(EstimatorSettings{}, tick_s);
  Muscle muscle(PhysicalParameters{}, tick_s);
  std::mt19937_64 random(3);
  *ever_trusted = false;
  const long ticks = std::lround(duration_s / tick_s);
  for (long k = 0; k < ticks; ++k) {
    const double power = power_W(tick_s * static_cast<double>(k));
    muscle.step(power);
    const double uniform = static_cast<double>(random() >> 11) * 0x1p-53 - 0.5;
    estimator.step(muscle.position_m() + noise_rms_m * std::sqrt(12.0) * uniform, power);
    if (k % 1000 == 0 && estimator.estimate()->trusted) *ever_trusted = true;
  }
  return *estimator.estimate();
}

}  // namespace

TEST_GROUP(Excitation){};

TEST(Excitation, SmallestEigenvalueIsTheClosedFormOfOrthogonalSines) {
  const Phi amplitude{3.0, 0.5, 2.0, 1.0};
  // The eigenvalue is the same in any coordinates.
  const Matrix<double, 4> turn =
      Matrix<double, 4>{{1, 2, 3, 4}, {0, 1, -1, 2}, {5, 0, 1, 1}, {1, 1, 1, -3}}
          .householderQr()
          .householderQ();
  for (const Matrix<double, 4>& basis : {Matrix<double, 4>(Matrix<double, 4>::Identity()), turn}) {
    ExcitationMonitor monitor({.window_s = 20.0}, block_step_s);
    for (long k = 1; k < 2000; ++k) {
      monitor.step(basis * orthogonal_sines(k, amplitude), 0.0, Phi::Zero());
      DOUBLES_EQUAL(0.0, monitor.min_eigenvalue(), 0.0);  // not before a whole window
    }
    monitor.step(basis * orthogonal_sines(2000, amplitude), 0.0, Phi::Zero());
    // ∫ a² sin² over whole periods = a² T/2.
    DOUBLES_EQUAL(0.25 * 20.0 / 2.0, monitor.min_eigenvalue(), 1e-9);
  }
}

TEST(Excitation, TheWindowForgetsOlderSamples) {
  ExcitationMonitor monitor({.window_s = 20.0}, block_step_s);
  for (long k = 0; k < 2000; ++k)
    monitor.step(orthogonal_sines(k, Phi::Constant(1.0)), 0.0, Phi::Zero());
  CHECK(monitor.min_eigenvalue() > 1.0);
  for (long k = 0; k < 2000; ++k)
    monitor.step(Phi{1.0, 0.0, 0.0, 0.0}, 0.0, Phi::Zero());
  DOUBLES_EQUAL(0.0, monitor.min_eigenvalue(), 1e-12);
  CHECK_FALSE(monitor.trusted());
}

TEST(Excitation, TheBoundHoldsForPresentParametersWhateverTheirHistory) {
  CHECK(rc::check("bound", [] {
    using supercoil::test::reals;
    const Phi amplitude{*reals(0.1, 2.0), *reals(0.1, 2.0), *reals(0.1, 2.0), *reals(0.1, 2.0)};
    const Phi error{*reals(-1.0, 1.0), *reals(-1.0, 1.0), *reals(-1.0, 1.0), *reals(-1.0, 1.0)};
    const double extra_frequency = *reals(0.1, 5.0);
    const auto seed = *rc::gen::arbitrary<unsigned>();
    std::mt19937_64 random(seed);
    ExcitationMonitor monitor({.window_s = 1.6}, block_step_s);
    for (long k = 0; k < 160; ++k) {
      Phi phi = orthogonal_sines(k, amplitude);
      phi[0] += std::sin(extra_frequency * block_step_s * static_cast<double>(k));
      for (int i = 0; i < 4; ++i)
        phi[i] += static_cast<double>(random() >> 11) * 0x1p-53 - 0.5;
      // Until the last tick the estimate's error is orthogonal to φ and does not show, as
      // adaptation would make it.
      const Phi truth = Phi::Ones();
      const Phi hidden = error - phi * (phi.dot(error) / phi.squaredNorm());
      monitor.step(phi, phi.dot(truth), truth + (k == 159 ? error : hidden));
    }
    RC_ASSERT(monitor.error_bound() >= error.norm() * (1.0 - 1e-6));
    RC_ASSERT(monitor.trusted() == (monitor.error_bound() <= 0.2));
  }));
}

TEST(Excitation, TheBoundIsReachedAlongTheWeakestDirection) {
  ExcitationMonitor monitor({.window_s = 20.0}, block_step_s);
  const Phi amplitude{3.0, 0.5, 2.0, 1.0};
  for (long k = 0; k < 2000; ++k) {
    const Phi phi = orthogonal_sines(k, amplitude);
    monitor.step(phi, phi.sum(), Phi{1.0, 0.7, 1.0, 1.0});
  }
  DOUBLES_EQUAL(0.3, monitor.error_bound(), 1e-6);
}

TEST(Excitation, NoEstimateIsTrustedAtRestOrUnderASingleSine) {
  bool trusted = true;
  learn(
      100.0, [](double) { return 2.0; }, 10e-6, &trusted);
  CHECK_FALSE(trusted);
  const auto sine = learn(
      200.0, [](double t) { return 2.0 + std::sin(0.25 * t); }, 10e-6, &trusted);
  CHECK_FALSE(trusted);
  CHECK(sine.relative_error_bound > 0.5);
}

TEST(Excitation, ARichInputIsTrustedOnceItsParametersAreRight) {
  bool trusted = false;
  const Estimate result = learn(200.0, supercoil::test::paper_power_W, 10e-6, &trusted);
  CHECK(result.trusted);
  const Theta off = result.theta.cwiseQuotient(theta_from(PhysicalParameters{})) - Theta::Ones();
  CHECK(off.cwiseAbs().maxCoeff() < 0.03);
  CHECK(off.norm() <= result.relative_error_bound);
}

TEST(Excitation, AnEstimatorOfKindNoneHasNoEstimate) {
  EstimatorSettings settings;
  settings.kind = EstimatorKind::none;
  Estimator estimator(settings, block_step_s);
  estimator.step(0.01, 1.0);
  CHECK_FALSE(estimator.estimate().has_value());
}
