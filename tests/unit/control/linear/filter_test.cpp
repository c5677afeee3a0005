#include "supercoil/control/linear/filter.hpp"

#include <complex>
#include <numbers>

#include <CppUTest/TestHarness.h>

#include "supercoil/control/estimation/parametric_model.hpp"

using namespace supercoil::control;

namespace {

using Complex = std::complex<double>;

/// 1/Λ(jω)
Complex closed_form(const Polynomial<3>& lambda, double omega) {
  const Complex s{0.0, omega};
  return 1.0 / (lambda[0] + s * (lambda[1] + s * (lambda[2] + s)));
}

/// The response of each state to sin(ωt), at ω, after the transients.
template <Hold hold>
std::array<Complex, 3> measured(double omega, double step_s) {
  StateVariableFilter<double, 3, hold> filter(paper_lambda, step_s);
  const double period_s = 2.0 * std::numbers::pi / omega;
  const long ticks = std::lround(period_s / step_s);
  const double exact_step = 2.0 * std::numbers::pi / static_cast<double>(ticks);  // in phase
  const long settled = std::lround(std::ceil(60.0 / period_s)) * ticks;
  std::array<Complex, 3> sum{};
  for (long k = 0; k < settled + ticks; ++k) {
    const double phase = exact_step * static_cast<double>(k);
    const double delayed = hold == Hold::zero_order ? phase - exact_step : phase;
    filter.step(std::sin(delayed));
    if (k < settled) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      sum[i] += filter.state()[static_cast<Eigen::Index>(i)] * std::polar(1.0, -phase);
    }
  }
  // ∫ sin e^(−jωt) over a period is −jT/2.
  for (Complex& value : sum)
    value *= Complex{0.0, 2.0} / static_cast<double>(ticks);
  return sum;
}

/// A step near the wanted one that divides the period, so that the frequency is met exactly.
double dividing_step(double omega, double near_s) {
  const double period_s = 2.0 * std::numbers::pi / omega;
  return period_s / std::round(period_s / near_s);
}

template <Hold hold>
double error_at(double omega, double near_s) {
  const auto response = measured<hold>(omega, dividing_step(omega, near_s));
  return std::abs(response[0] / closed_form(paper_lambda, omega) - 1.0);
}

}  // namespace

TEST_GROUP(Filter){};

TEST(Filter, AmplitudeAndPhaseAreThoseOfOneOverLambda) {
  for (const double omega : {0.25, 1.0, 2.5, 8.0}) {
    const auto response = measured<Hold::first_order>(omega, dividing_step(omega, 1e-3));
    const Complex expected = closed_form(paper_lambda, omega);
    DOUBLES_EQUAL(1.0, std::abs(response[0]) / std::abs(expected), 1e-5);
    DOUBLES_EQUAL(0.0, std::arg(response[0] / expected), 1e-5);
  }
}

TEST(Filter, StatesAreDerivativesOfTheFirst) {
  for (const double omega : {0.25, 1.0, 2.5, 8.0}) {
    const auto response = measured<Hold::first_order>(omega, dividing_step(omega, 1e-3));
    const Complex s{0.0, omega};
    DOUBLES_EQUAL(0.0, std::abs(response[1] / (s * response[0]) - 1.0), 1e-5);
    DOUBLES_EQUAL(0.0, std::abs(response[2] / (s * s * response[0]) - 1.0), 1e-5);
  }
}

TEST(Filter, FirstOrderHoldConvergesWithTheSquareOfTheStep) {
  const double coarse = error_at<Hold::first_order>(2.5, 0.04);
  const double fine = error_at<Hold::first_order>(2.5, 0.02);
  CHECK(coarse > 1e-5);  // otherwise there is nothing to compare
  DOUBLES_EQUAL(4.0, coarse / fine, 0.2);
}

TEST(Filter, ZeroOrderHoldOfASmoothSignalConvergesWithTheStep) {
  const double coarse = error_at<Hold::zero_order>(2.5, 0.02);
  const double fine = error_at<Hold::zero_order>(2.5, 0.01);
  DOUBLES_EQUAL(2.0, coarse / fine, 0.05);
}

TEST(Filter, HighestDerivativeSettlesToZeroAndTheFirstStateToTheDcGain) {
  StateVariableFilter<double, 3, Hold::first_order> filter(paper_lambda, 1e-2);
  filter.step(3.0);
  DOUBLES_EQUAL(3.0, filter.highest_derivative(3.0), 0.1);  // nearly all of it at first
  for (int k = 0; k < 3000; ++k)
    filter.step(3.0);
  DOUBLES_EQUAL(0.3, filter.state()[0], 1e-9);
  DOUBLES_EQUAL(0.0, filter.highest_derivative(3.0), 1e-8);
}

TEST(Filter, FixedPointStatesFollowDouble) {
  StateVariableFilter<double, 3, Hold::first_order> exact(paper_lambda, 1e-3);
  StateVariableFilter<Q8_24, 3, Hold::first_order> fixed(paper_lambda, 1e-3);
  double worst = 0.0;
  for (int k = 0; k < 20000; ++k) {
    // The same input to both, so that only the filters' own arithmetic differs.
    const Q8_24 input{2.5 + std::sin(1e-3 * k) + std::sin(2.5e-4 * k)};
    exact.step(static_cast<double>(input));
    fixed.step(input);
    worst = std::fmax(worst, (fixed.state().cast<double>() - exact.state()).cwiseAbs().maxCoeff());
  }
  CHECK(worst < 1e-9);
}

TEST(Filter, OnePoleBankIsExactForHeldSignalsAndRamps) {
  const double pole = 4.0;
  const double step_s = 0.01;
  OnePoleBank<double, 2> bank(pole, step_s, {true, false});
  for (int k = 0; k <= 200; ++k) {
    const double t = step_s * k;
    bank.step({1.0, t});
    // With a hold, an input that arrives at a tick acts from that tick on.
    DOUBLES_EQUAL((1.0 - std::exp(-pole * t)) / pole, bank.state()[0], 1e-13);
    DOUBLES_EQUAL(t / pole - (1.0 - std::exp(-pole * t)) / (pole * pole), bank.state()[1], 1e-13);
  }
}
