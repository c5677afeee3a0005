#include "board/known_heat.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>

#include "board/heat.hpp"
#include "board/steady_state.hpp"
#include "unit/firmware/core/support/tick.hpp"

using namespace supercoil;
using namespace supercoil::board;
using supercoil::board::ThermalFacts;
using supercoil::test::tick_s;

namespace {

constexpr PowerBounds::Interval compared_power{0.98 * 0.98, 1.02 * 1.02};

ThermalSettings weighed_muscle() {
  ThermalSettings s;
  s.mass_error_ratio = 0.03;
  return s;
}

/// For the paper's muscle, at 2 W.
ThermalFacts found_of_paper() {
  ThermalFacts facts;
  facts.time_constant_s = 0.162 / 0.089;
  facts.time_constant_at_W = 2.0;
  return facts;
}

}  // namespace

TEST_GROUP(KnownThermalBounds){};

TEST(KnownThermalBounds, AreAsConfiguredWithoutAWeighedMass) {
  const ThermalSettings s;
  const KnownThermalBounds known = known_thermal_bounds(s, found_of_paper());
  LONGS_EQUAL(0, known.count);
  DOUBLES_EQUAL(s.bounds.min_mass_J_per_K, known.bounds.min_mass_J_per_K, 0.0);
  DOUBLES_EQUAL(s.bounds.max_mass_J_per_K, known.bounds.max_mass_J_per_K, 0.0);
  for (const double rise_K : {1.0, 30.0, 150.0}) {
    DOUBLES_EQUAL(s.bounds.min_transfer_W_per_K, known.min_heat_transfer_W_per_K(rise_K), 0.0);
    DOUBLES_EQUAL(s.bounds.max_transfer_W_per_K, known.max_heat_transfer_W_per_K(rise_K), 0.0);
  }
}

TEST(KnownThermalBounds, OfAWeighedMuscleAreItsMassOverItsTimeConstant) {
  const KnownThermalBounds known = known_thermal_bounds(weighed_muscle(), found_of_paper());
  DOUBLES_EQUAL(0.97 * 0.162, known.bounds.min_mass_J_per_K, 1e-12);
  DOUBLES_EQUAL(1.03 * 0.162, known.bounds.max_mass_J_per_K, 1e-12);
  // 2 W correspond to 22.5 K.
  DOUBLES_EQUAL(0.97 * 0.089 / 1.25, known.min_heat_transfer_W_per_K(22.5), 1e-9);
  DOUBLES_EQUAL(1.03 * 0.089 * 1.25, known.max_heat_transfer_W_per_K(22.0), 1e-9);
  CHECK_COMPARE(known.min_heat_transfer_W_per_K(5.0), <, known.min_heat_transfer_W_per_K(16.0));
  CHECK_COMPARE(known.max_heat_transfer_W_per_K(60.0), >, known.max_heat_transfer_W_per_K(22.0));
}

TEST(KnownThermalBounds, OfATimeConstantHoldFromSevenTenthsOfItsMeanRiseUpToIt) {
  const KnownThermalBounds known = known_thermal_bounds(weighed_muscle(), found_of_paper());
  const double mean_K = 2.0 / 0.089;
  const double min_W_per_K = 0.97 * 0.089 / 1.25;
  const double max_W_per_K = 1.03 * 0.089 * 1.25;
  DOUBLES_EQUAL(min_W_per_K, known.min_heat_transfer_W_per_K(0.701 * mean_K), 1e-9);
  DOUBLES_EQUAL(max_W_per_K, known.max_heat_transfer_W_per_K(0.999 * mean_K), 1e-9);
  // The heat transfer may be less when colder and more when hotter, as the cube root of the rise.
  DOUBLES_EQUAL(min_W_per_K * std::cbrt(6.0 / 7.0), known.min_heat_transfer_W_per_K(0.6 * mean_K),
                1e-9);
  DOUBLES_EQUAL(max_W_per_K * std::cbrt(1.05), known.max_heat_transfer_W_per_K(1.05 * mean_K),
                1e-9);
}

TEST(KnownThermalBounds, NeverLeaveTheConfiguredBounds) {
  ThermalSettings s = weighed_muscle();
  s.mass_error_ratio = 0.5;
  for (const double ratio : {0.05, 0.5, 1.0, 2.0, 20.0}) {
    ThermalFacts facts = found_of_paper();
    facts.time_constant_s *= ratio;
    const KnownThermalBounds known = known_thermal_bounds(s, facts);
    CHECK_COMPARE(known.bounds.min_mass_J_per_K, >=, s.bounds.min_mass_J_per_K);
    CHECK_COMPARE(known.bounds.max_mass_J_per_K, <=, s.bounds.max_mass_J_per_K);
    for (const double rise_K : {0.0, 3.0, 20.0, 140.0}) {
      CHECK_COMPARE(known.min_heat_transfer_W_per_K(rise_K), >=, s.bounds.min_transfer_W_per_K);
      CHECK_COMPARE(known.min_heat_transfer_W_per_K(rise_K), <=, s.bounds.max_transfer_W_per_K);
      CHECK_COMPARE(known.max_heat_transfer_W_per_K(rise_K), <=, s.bounds.max_transfer_W_per_K);
      CHECK_COMPARE(known.max_heat_transfer_W_per_K(rise_K), >=, s.bounds.min_transfer_W_per_K);
    }
  }
}

TEST(KnownThermalBounds, ForMeasuredPowerAreDividedByTrueOverMeasured) {
  const KnownThermalBounds known = known_thermal_bounds(weighed_muscle(), found_of_paper());
  ThermalFacts facts = found_of_paper();
  facts.steady_rise_K = 17.0;
  facts.steady_error_K = 1.0;
  facts.steady_min_W = 1.5;
  facts.steady_max_W = 1.6;
  const KnownThermalBounds read =
      known_thermal_bounds_by_reading(weighed_muscle(), facts, compared_power);
  const double max_ratio = compared_power.max;
  const double min_ratio = compared_power.min;
  DOUBLES_EQUAL(known.bounds.min_mass_J_per_K / max_ratio, read.bounds.min_mass_J_per_K, 1e-12);
  DOUBLES_EQUAL(known.bounds.max_mass_J_per_K / min_ratio, read.bounds.max_mass_J_per_K, 1e-12);
  DOUBLES_EQUAL(known.bounds.min_transfer_W_per_K / max_ratio, read.bounds.min_transfer_W_per_K,
                1e-12);
  DOUBLES_EQUAL(known.bounds.max_transfer_W_per_K / min_ratio, read.bounds.max_transfer_W_per_K,
                1e-12);
  LONGS_EQUAL(2, read.count);
  DOUBLES_EQUAL(known.spans[0].min_W_per_K / max_ratio, read.spans[0].min_W_per_K, 1e-12);
  DOUBLES_EQUAL(known.spans[0].max_W_per_K / min_ratio, read.spans[0].max_W_per_K, 1e-12);
  // The reading itself is already in measured power.
  DOUBLES_EQUAL(1.5 / 18.0, read.spans[1].min_W_per_K, 1e-12);
  DOUBLES_EQUAL(1.6 / 16.0, read.spans[1].max_W_per_K, 1e-12);
}

TEST(KnownThermalBounds, ClearingAReadingRemovesAllOfIt) {
  ThermalFacts facts = found_of_paper();
  facts.steady_rise_K = 17.0;
  facts.steady_error_K = 1.0;
  facts.steady_min_W = 1.5;
  facts.steady_max_W = 1.6;
  facts.clear_reading();
  CHECK(facts == found_of_paper());
}

TEST_GROUP(SteadyState) {
  ThermalSettings settings;
  ThermalFacts facts;

  /// Holds 1.5 W for this time; the slowest muscle within the bounds takes 4.4 s.
  SteadyState held(double time_s) const {
    SteadyState steady(settings, tick_s);
    hold(steady, time_s);
    return steady;
  }
  static void hold(SteadyState & steady, double time_s) {
    for (long i = std::lround(time_s / tick_s); i > 0; --i)
      steady.step({1.5, 1.51}, 40.0);
  }
};

TEST(SteadyState, AcceptsAReadingOnceTheMuscleMustBeSteady) {
  CHECK(held(20.0).read(17.0, compared_power, facts) == Refusal::not_ready);
  CHECK_FALSE(facts.has_reading());
  CHECK(held(23.0).read(17.0, compared_power, facts) == Refusal::none);
  DOUBLES_EQUAL(17.0, facts.steady_rise_K, 0.0);
  // The thermometer's kelvin, plus what remains of 40 K after five time constants.
  DOUBLES_EQUAL(1.0 + 40.0 * std::exp(-5.0), facts.steady_error_K, 1e-9);
  DOUBLES_EQUAL(1.5, facts.steady_min_W, 1e-9);
  DOUBLES_EQUAL(1.51, facts.steady_max_W, 1e-9);
}

TEST(SteadyState, AveragesThePowerOverHalfOfTheSlowestTimeConstant) {
  SteadyState steady = held(30.0);
  const double half_s =
      0.5 * settings.bounds.max_mass_J_per_K / settings.bounds.min_transfer_W_per_K;
  for (long i = std::lround(half_s / tick_s); i > 0; --i)
    steady.step({1.7, 1.71}, 40.0);
  CHECK(steady.read(17.0, compared_power, facts) == Refusal::none);
  DOUBLES_EQUAL(1.7 - 0.2 * std::exp(-1.0), facts.steady_min_W, 1e-4);
  DOUBLES_EQUAL(1.71 - 0.2 * std::exp(-1.0), facts.steady_max_W, 1e-4);
}

TEST(SteadyState, WaitsAgainAfterAChangeOfPower) {
  SteadyState steady = held(30.0);
  steady.restart();
  hold(steady, 20.0);
  CHECK(steady.read(17.0, compared_power, facts) == Refusal::not_ready);
}

TEST(SteadyState, IgnoresPowerBeforeTheLastChange) {
  SteadyState steady = held(30.0);
  steady.restart();
  for (long i = std::lround(23.0 / tick_s); i > 0; --i)
    steady.step({1.2, 1.22}, 25.0);
  CHECK(steady.read(14.0, compared_power, facts) == Refusal::none);
  DOUBLES_EQUAL(1.2, facts.steady_min_W, 1e-9);
  DOUBLES_EQUAL(1.22, facts.steady_max_W, 1e-9);
  DOUBLES_EQUAL(1.0 + 25.0 * std::exp(-5.0), facts.steady_error_K, 1e-9);
}

TEST(SteadyState, RefusesReadingsThatTheMuscleCannotHave) {
  const SteadyState steady = held(30.0);
  // 1.5 W over the configured 0.045 to 0.18 W/K is 8.3 to 33 K.
  for (const double rise_K : {-17.0, 0.5, 2.0, 6.0, 40.0, 170.0, 1e9, std::nan("")})
    CHECK(steady.read(rise_K, compared_power, facts) == Refusal::out_of_range);
  CHECK_FALSE(facts.has_reading());
  // For a muscle whose time constant and mass are known, the range is narrower.
  settings = weighed_muscle();
  facts = found_of_paper();
  const SteadyState known = held(30.0);
  CHECK(known.read(10.0, compared_power, facts) == Refusal::out_of_range);
  CHECK(known.read(17.0, compared_power, facts) == Refusal::none);
}

TEST(SteadyState, AllowsForTheErrorsOfTheSenses) {
  const SteadyState steady = held(30.0);
  const double error_K = 1.0 + 40.0 * std::exp(-5.0);
  const double lowest_K = 1.5 * compared_power.min / 0.18 - error_K;
  const double highest_K = 1.51 * compared_power.max / 0.045 + error_K;
  for (const double rise_K : {lowest_K + 0.01, highest_K - 0.01})
    CHECK(steady.read(rise_K, compared_power, facts) == Refusal::none);
  for (const double rise_K : {lowest_K - 0.01, highest_K + 0.01})
    CHECK(steady.read(rise_K, compared_power, facts) == Refusal::out_of_range);
}

TEST_GROUP(HeatByReading) {
  ThermalSettings settings;

  /// Held at a power for good, with senses that read 2 % too high or too low.
  static Heat held(const ThermalSettings& settings, const ThermalFacts& facts,
                   double measured_power_W) {
    Heat heat(settings, {}, tick_s);
    heat.set_thermal_facts(facts, compared_power);
    for (int i = 0; i < 60'000; ++i) {
      heat.step(compared_power.min * measured_power_W, compared_power.max * measured_power_W,
                measured_power_W);
    }
    return heat;
  }
};

TEST(HeatByReading, IsIndependentOfTheErrorsOfTheSenses) {
  const ThermalFacts facts{0.0, 0.0, 16.85, 1.0, 1.5, 1.5};
  const Heat heat = held(settings, facts, 1.5);
  // At the power of the reading, only the thermometer's error remains.
  DOUBLES_EQUAL(17.85, heat.hottest_K(), 0.5);
  DOUBLES_EQUAL(15.85, heat.coldest_K(), 0.5);
  CHECK_COMPARE(heat.hottest_K(), >=, 17.85);
  CHECK_COMPARE(heat.coldest_K(), <=, 15.85);
}

TEST(HeatByReading, IsWiderWhereAReadingOfThePowerIsMissing) {
  const ThermalFacts facts{0.0, 0.0, 16.85, 1.0, 1.5, 1.5};
  Heat sensed(settings, {}, tick_s);
  sensed.set_thermal_facts(facts, compared_power);
  Heat blind = sensed;
  for (int i = 0; i < 60'000; ++i) {
    sensed.step(0.0, 1.5, 1.5);
    blind.step(0.0, 1.5, 1.5, false);
  }
  DOUBLES_EQUAL(compared_power.max / compared_power.min, blind.hottest_K() / sensed.hottest_K(),
                0.03);
}

TEST(HeatByReading, IsForgottenWithoutAJump) {
  ThermalFacts facts{0.0, 0.0, 16.85, 1.0, 1.5, 1.5};
  Heat heat = held(settings, facts, 1.5);
  facts.clear_reading();
  heat.set_thermal_facts(facts, compared_power);
  CHECK_COMPARE(heat.hottest_K(), >=, 17.85);
  for (int i = 0; i < 60'000; ++i)
    heat.step(1.5, 1.5, 1.5);
  DOUBLES_EQUAL(1.5 / settings.bounds.min_transfer_W_per_K, heat.hottest_K(), 0.01);
}
