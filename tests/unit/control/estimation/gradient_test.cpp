#include "supercoil/control/estimation/gradient.hpp"

#include <CppUTest/TestHarness.h>
#include <rapidcheck.h>

#include "supercoil/control/actuator/conversions.hpp"

#include "unit/control/support/generators.hpp"
#include "unit/control/support/muscle.hpp"
#include "unit/control/support/reference.hpp"

using namespace supercoil::control;
using supercoil::test::Muscle;
using supercoil::test::paper_power_W;

namespace {

/// Feeds the estimator what the paper's muscle does under Eq. (18); observe(time_s) at each tick.
template <class Observe>
void identify(GradientEstimator<double>& estimator, const GradientSettings& settings, double step_s,
              double duration_s, Observe observe) {
  Muscle muscle(PhysicalParameters{}, step_s);
  const long ticks = std::lround(duration_s / step_s);
  for (long k = 1; k <= ticks; ++k) {
    const double power_W = paper_power_W(static_cast<double>(k - 1) * step_s);
    muscle.step(power_W);
    estimator.step(muscle.position_m() / settings.scale.dc_gain_m_per_W, power_W);
    observe(static_cast<double>(k) * step_s);
  }
}

/// The largest difference from the differential equation over 30 s, relative to each parameter.
double difference_to_ode(const nlohmann::json& expected, double step_s) {
  const GradientSettings settings;
  GradientEstimator<double> estimator(settings, step_s);
  const std::vector<double> times = expected.at("time_s");
  std::size_t next = 0;
  double worst = 0.0;
  identify(estimator, settings, step_s, 30.0, [&](double time_s) {
    if (next == times.size() || std::abs(time_s - times[next]) > 0.5 * step_s) return;
    const auto theta = supercoil::test::vector_from<Theta>(expected.at("theta").at(next));
    const Theta relative = (estimator.theta() - theta).cwiseQuotient(settings.scale.nominal);
    worst = std::fmax(worst, relative.cwiseAbs().maxCoeff());
    ++next;
  });
  LONGS_EQUAL(times.size(), next);
  return worst;
}

}  // namespace

TEST_GROUP(Gradient){};

/// A warm muscle's position must not look like a step from zero.
TEST(Gradient, KeepsWhatItLearnedWhenAWarmMuscleIsHeatedAgain) {
  constexpr double step_s = 1e-3;
  GradientSettings settings;
  settings.initial = settings.scale.nominal;
  GradientEstimator<double> estimator(settings, step_s);
  Muscle muscle(PhysicalParameters{}, step_s);
  long tick = 0;
  const auto run_until = [&](double time_s, bool heats) {
    for (; tick < std::lround(time_s / step_s); ++tick) {
      const double power_W = heats ? paper_power_W(static_cast<double>(tick) * step_s) : 0.0;
      muscle.step(power_W);
      if (heats) estimator.step(muscle.position_m() / settings.scale.dc_gain_m_per_W, power_W);
    }
  };
  run_until(60.0, true);
  run_until(60.3, false);
  estimator.restart();
  const Theta nominal = settings.scale.nominal;
  for (int tenth = 604; tenth < 900; ++tenth) {
    run_until(0.1 * tenth, true);
    CHECK_COMPARE((estimator.theta() - nominal).cwiseQuotient(nominal).norm(), <, 0.1);
  }
}

TEST(Gradient, FollowsThePapersDifferentialEquationToFirstOrderInTheStep) {
  const auto expected = supercoil::test::reference("estimation", "gradient");
  const double coarse = difference_to_ode(expected, 2e-3);
  const double fine = difference_to_ode(expected, 1e-3);
  CHECK(fine < 5e-3);
  DOUBLES_EQUAL(2.0, coarse / fine, 0.2);
}

TEST(Gradient, StartsAtTheGivenTheta) {
  const GradientSettings settings;
  const GradientEstimator<double> estimator(settings, 1e-3);
  CHECK((estimator.theta() - Theta{0.1, 5.0, 30.0, 20.0}).norm() < 1e-12);
}

TEST(Gradient, TrueParametersStayUnchanged) {
  GradientSettings settings;
  settings.initial = theta_from(PhysicalParameters{});
  GradientEstimator<double> estimator(settings, 1e-3);
  identify(estimator, settings, 1e-3, 30.0, [&](double) {
    const Theta off = (estimator.theta() - settings.initial).cwiseQuotient(settings.scale.nominal);
    CHECK(off.cwiseAbs().maxCoeff() < 1e-4);
  });
}

TEST(Gradient, NeverLeavesItsBounds) {
  GradientSettings settings;
  settings.bounds = Box<double, 4>{Theta{0.05, 1.0, 10.0, 10.0}, Theta{5.0, 10.0, 100.0, 60.0}};
  GradientEstimator<double> estimator(settings, 1e-3);
  bool touched = false;
  // A little slack for rounding: the estimator keeps θ divided by its nominal value.
  const Box<double, 4> box{settings.bounds->lower * (1 - 1e-12),
                           settings.bounds->upper * (1 + 1e-12)};
  identify(estimator, settings, 1e-3, 30.0, [&](double) {
    CHECK(box.contains(estimator.theta()));
    touched = touched || estimator.theta()[3] > 0.999 * settings.bounds->upper[3];
  });
  CHECK(touched);
}

TEST(Gradient, NormalisationKeepsAThousandfoldGainBoundedWhereThePlainLawDiverges) {
  const auto largest = [](double normalisation) {
    GradientSettings settings;
    settings.gain *= 1000.0;
    settings.normalisation = normalisation;
    GradientEstimator<double> estimator(settings, 1e-3);
    double result = 0.0;
    identify(estimator, settings, 1e-3, 30.0, [&](double) {
      const double size =
          estimator.theta().cwiseQuotient(settings.scale.nominal).cwiseAbs().maxCoeff();
      result = size < 1e12 ? std::fmax(result, size) : 1e12;  // a NaN counts as diverged
    });
    return result;
  };
  CHECK(largest(0.0) >= 1e6);
  CHECK(largest(0.5) < 20.0);
  CHECK(largest(1.0) < 20.0);
}

TEST(Gradient, ProjectionIsTheNearestPointOfTheBox) {
  CHECK(rc::check("nearest", [] {
    using supercoil::test::reals;
    const auto any = [] { return Vector<double, 2>{*reals(-3.0, 3.0), *reals(-3.0, 3.0)}; };
    const Vector<double, 2> corner = any();
    const Vector<double, 2> other = any();
    const Box<double, 2> box{corner.cwiseMin(other), corner.cwiseMax(other)};
    const Vector<double, 2> value = any();
    const Vector<double, 2> projected = project(value, box);
    RC_ASSERT(box.contains(projected));
    RC_ASSERT(box.contains(value) == (projected == value));
    const Vector<double, 2> inside = project(any(), box);
    RC_ASSERT((projected - value).norm() <= (inside - value).norm());
  }));
}
