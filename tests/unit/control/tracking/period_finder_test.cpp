// Finds the periods of references that have one, and none in references that have not.
#include "supercoil/control/tracking/period_finder.hpp"

#include <array>
#include <cmath>
#include <random>

#include <CppUTest/TestHarness.h>

using supercoil::control::PeriodFinder;

namespace {

constexpr double step_s = 1e-3;

/// Feeds the reference to the finder over a span of time; returns whether it ever knew a period.
template <class Reference>
bool show(PeriodFinder& finder, Reference reference, double from_s, double to_s) {
  bool known = false;
  for (int k = static_cast<int>(from_s / step_s); k < static_cast<int>(to_s / step_s); ++k) {
    finder.step(reference(k * step_s));
    known = known || finder.period_s() > 0.0;
  }
  return known;
}

double steps_m(double time_s) {
  constexpr std::array<double, 4> levels_m{0.005, 0.015, 0.008, 0.020};
  return levels_m[static_cast<std::size_t>(time_s / 20.0) % levels_m.size()];
}

}  // namespace

TEST_GROUP(PeriodFinder) {
  PeriodFinder finder{step_s};
};

TEST(PeriodFinder, FindsASinesPeriodToAThousandthAfterThreePeriods) {
  const double turn = 8.0 * std::atan(1.0);
  for (const double rad_per_s : {3.0, 0.25, 0.025}) {
    finder.restart();
    const double period_s = turn / rad_per_s;
    show(
        finder, [&](double t) { return 0.011 + 0.009 * std::sin(rad_per_s * t); }, 0.0,
        3.1 * period_s);
    DOUBLES_EQUAL(period_s, finder.period_s(), 1e-3 * period_s);
  }
}

TEST(PeriodFinder, FindsThePeriodOfSteps) {
  show(finder, steps_m, 0.0, 240.0);
  DOUBLES_EQUAL(80.0, finder.period_s(), 0.002);
}

TEST(PeriodFinder, TakesTheWholePeriodWhereTheReferenceRisesTwiceInIt) {
  show(
      finder, [](double t) { return std::sin(0.25 * t) + 0.9 * std::sin(1.25 * t + 1.0); }, 0.0,
      100.0);
  DOUBLES_EQUAL(32.0 * std::atan(1.0), finder.period_s(), 0.02);
}

TEST(PeriodFinder, ForgetsAPeriodThatEndsAndFindsTheNext) {
  const auto sine = [](double t) { return std::sin(0.5 * t); };
  CHECK(show(finder, sine, 0.0, 60.0));
  show(
      finder, [](double t) { return std::sin(0.7 * t + 1.0); }, 60.0, 64.0);
  DOUBLES_EQUAL(0.0, finder.period_s(), 0.0);
  show(
      finder, [](double t) { return std::sin(0.7 * t + 1.0); }, 64.0, 110.0);
  DOUBLES_EQUAL(8.0 * std::atan(1.0) / 0.7, finder.period_s(), 0.01);
}

TEST(PeriodFinder, FindsNoneWithoutRepetition) {
  CHECK(!show(
      finder, [](double) { return 0.011; }, 0.0, 1000.0));
  finder.restart();
  CHECK(!show(
      finder, [](double t) { return std::sin(0.25 * t) + 0.01 * t; }, 0.0, 1000.0));
  finder.restart();
  CHECK(!show(
      finder, [](double t) { return std::sin(0.25 * t) + std::sin(0.25 * 1.41421 * t); }, 0.0,
      2600.0));
}

TEST(PeriodFinder, FindsNoneInRandomSteps) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 source(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    double until_s = 0.0;
    double level = 0.0;
    finder.restart();
    const bool known = show(
        finder,
        [&](double time_s) {
          if (time_s >= until_s) {
            until_s = time_s + 5.0 + 25.0 * uniform(source);
            level = uniform(source);
          }
          return level;
        },
        0.0, 1000.0);
    CHECK(!known);
  }
}
