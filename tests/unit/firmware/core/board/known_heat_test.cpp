#include "board/known_heat.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>

#include "board/heat.hpp"
#include "board/steady_heat.hpp"
#include "unit/firmware/core/support/tick.hpp"

using namespace supercoil;
using namespace supercoil::board;
using supercoil::board::HeatFacts;
using supercoil::test::tick_s;

namespace {

constexpr PowerBounds::Interval compared_power{0.98 * 0.98, 1.02 * 1.02};

ThermalSettings weighed_muscle() {
  ThermalSettings s;
  s.mass_error_ratio = 0.03;
  return s;
}

/// Of the paper's muscle, at 2 W.
HeatFacts found_of_paper() {
  HeatFacts facts;
  facts.time_constant_s = 0.162 / 0.089;
  facts.time_constant_at_W = 2.0;
  return facts;
}

}  // namespace

TEST_GROUP(KnownHeat){};

TEST(KnownHeat, IsWhatIsConfiguredWhereNothingWasWeighed) {
  const ThermalSettings s;
  const KnownHeat known = known_heat(s, found_of_paper());
  LONGS_EQUAL(0, known.count);
  DOUBLES_EQUAL(s.bounds.lowest_mass_J_per_K, known.bounds.lowest_mass_J_per_K, 0.0);
  DOUBLES_EQUAL(s.bounds.highest_mass_J_per_K, known.bounds.highest_mass_J_per_K, 0.0);
  for (const double rise_K : {1.0, 30.0, 150.0}) {
    DOUBLES_EQUAL(s.bounds.lowest_transfer_W_per_K, known.lowest_W_per_K(rise_K), 0.0);
    DOUBLES_EQUAL(s.bounds.highest_transfer_W_per_K, known.highest_W_per_K(rise_K), 0.0);
  }
}

TEST(KnownHeat, OfAWeighedMuscleIsItsMassOverItsTimeConstant) {
  const KnownHeat known = known_heat(weighed_muscle(), found_of_paper());
  DOUBLES_EQUAL(0.97 * 0.162, known.bounds.lowest_mass_J_per_K, 1e-12);
  DOUBLES_EQUAL(1.03 * 0.162, known.bounds.highest_mass_J_per_K, 1e-12);
  // 2 W are 22.5 K.
  DOUBLES_EQUAL(0.97 * 0.089 / 1.25, known.lowest_W_per_K(22.5), 1e-9);
  DOUBLES_EQUAL(1.03 * 0.089 * 1.25, known.highest_W_per_K(22.0), 1e-9);
  CHECK_COMPARE(known.lowest_W_per_K(5.0), <, known.lowest_W_per_K(16.0));
  CHECK_COMPARE(known.highest_W_per_K(60.0), >, known.highest_W_per_K(22.0));
}

TEST(KnownHeat, NeverLeavesWhatIsConfigured) {
  ThermalSettings s = weighed_muscle();
  s.mass_error_ratio = 0.5;
  for (const double ratio : {0.05, 0.5, 1.0, 2.0, 20.0}) {
    HeatFacts facts = found_of_paper();
    facts.time_constant_s *= ratio;
    const KnownHeat known = known_heat(s, facts);
    CHECK_COMPARE(known.bounds.lowest_mass_J_per_K, >=, s.bounds.lowest_mass_J_per_K);
    CHECK_COMPARE(known.bounds.highest_mass_J_per_K, <=, s.bounds.highest_mass_J_per_K);
    for (const double rise_K : {0.0, 3.0, 20.0, 140.0}) {
      CHECK_COMPARE(known.lowest_W_per_K(rise_K), >=, s.bounds.lowest_transfer_W_per_K);
      CHECK_COMPARE(known.lowest_W_per_K(rise_K), <=, s.bounds.highest_transfer_W_per_K);
      CHECK_COMPARE(known.highest_W_per_K(rise_K), <=, s.bounds.highest_transfer_W_per_K);
      CHECK_COMPARE(known.highest_W_per_K(rise_K), >=, s.bounds.lowest_transfer_W_per_K);
    }
  }
}

TEST_GROUP(SteadyHeat) {
  ThermalSettings settings;
  HeatFacts facts;

  /// Held at 1.5 W for so long; the slowest that the bounds allow takes 4.4 s.
  SteadyHeat held(double time_s) const {
    SteadyHeat steady(settings, tick_s);
    hold(steady, time_s);
    return steady;
  }
  static void hold(SteadyHeat & steady, double time_s) {
    for (long i = std::lround(time_s / tick_s); i > 0; --i)
      steady.step({1.5, 1.51}, 40.0);
  }
};

TEST(SteadyHeat, TakesAReadingWhenTheMuscleMustBeInSteadyHeat) {
  CHECK(held(20.0).read(17.0, compared_power, facts) == Refusal::not_ready);
  CHECK_FALSE(facts.was_read());
  CHECK(held(23.0).read(17.0, compared_power, facts) == Refusal::none);
  DOUBLES_EQUAL(17.0, facts.steady_rise_K, 0.0);
  // The thermometer's kelvin, and what is left of 40 K after five time constants.
  DOUBLES_EQUAL(1.0 + 40.0 * std::exp(-5.0), facts.steady_error_K, 1e-9);
  DOUBLES_EQUAL(1.5, facts.steady_min_W, 1e-9);
  DOUBLES_EQUAL(1.51, facts.steady_max_W, 1e-9);
}

TEST(SteadyHeat, WaitsAnewWhenThePowerIsAnotherOne) {
  SteadyHeat steady = held(30.0);
  steady.restart();
  hold(steady, 20.0);
  CHECK(steady.read(17.0, compared_power, facts) == Refusal::not_ready);
}

TEST(SteadyHeat, RefusesWhatTheMuscleCannotBe) {
  const SteadyHeat steady = held(30.0);
  // 1.5 W over the configured 0.045 to 0.18 W/K is 8.3 to 33 K.
  for (const double rise_K : {-17.0, 0.5, 2.0, 6.0, 40.0, 170.0, 1e9, std::nan("")})
    CHECK(steady.read(rise_K, compared_power, facts) == Refusal::out_of_range);
  CHECK_FALSE(facts.was_read());
  // Of a muscle whose time constant is known with its mass, less is possible.
  settings = weighed_muscle();
  facts = found_of_paper();
  const SteadyHeat known = held(30.0);
  CHECK(known.read(10.0, compared_power, facts) == Refusal::out_of_range);
  CHECK(known.read(17.0, compared_power, facts) == Refusal::none);
}

TEST_GROUP(HeatThatWasRead) {
  ThermalSettings settings;

  /// Held at a power for good, with senses that tell 2 % too much of it or too little.
  static Heat held(const ThermalSettings& settings, const HeatFacts& facts, double told_W) {
    Heat heat(settings, {}, tick_s);
    heat.know(facts, compared_power);
    for (int i = 0; i < 60'000; ++i)
      heat.step(compared_power.min * told_W, compared_power.max * told_W, told_W);
    return heat;
  }
};

TEST(HeatThatWasRead, DoesNotSufferFromTheSensesErrors) {
  const HeatFacts facts{0.0, 0.0, 16.85, 1.0, 1.5, 1.5};
  const Heat heat = held(settings, facts, 1.5);
  // At the power at which it was read, what is left is what the thermometer errs by.
  DOUBLES_EQUAL(17.85, heat.hottest_K(), 0.5);
  DOUBLES_EQUAL(15.85, heat.coldest_K(), 0.5);
  CHECK_COMPARE(heat.hottest_K(), >=, 17.85);
  CHECK_COMPARE(heat.coldest_K(), <=, 15.85);
}

TEST(HeatThatWasRead, IsWiderWhereAReadingOfThePowerIsMissing) {
  const HeatFacts facts{0.0, 0.0, 16.85, 1.0, 1.5, 1.5};
  Heat sensed(settings, {}, tick_s);
  sensed.know(facts, compared_power);
  Heat blind = sensed;
  for (int i = 0; i < 60'000; ++i) {
    sensed.step(0.0, 1.5, 1.5);
    blind.step(0.0, 1.5, 1.5, false);
  }
  DOUBLES_EQUAL(compared_power.max / compared_power.min, blind.hottest_K() / sensed.hottest_K(),
                0.03);
}

TEST(HeatThatWasRead, IsForgottenWithoutAJump) {
  HeatFacts facts{0.0, 0.0, 16.85, 1.0, 1.5, 1.5};
  Heat heat = held(settings, facts, 1.5);
  facts.forget_reading();
  heat.know(facts, compared_power);
  CHECK_COMPARE(heat.hottest_K(), >=, 17.85);
  for (int i = 0; i < 60'000; ++i)
    heat.step(1.5, 1.5, 1.5);
  DOUBLES_EQUAL(1.5 / settings.bounds.lowest_transfer_W_per_K, heat.hottest_K(), 0.01);
}
