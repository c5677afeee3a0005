#include "board/heat.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>

#include "unit/firmware/core/support/tick.hpp"

using namespace supercoil;
using namespace supercoil::board;
using supercoil::test::tick_s;

namespace {

constexpr double heating_W = 2.0;

double hottest_after_K(const ThermalSettings& settings, double learned_pole_rad_per_s,
                       double time_s) {
  Heat heat(settings, {}, tick_s);
  heat.learn(learned_pole_rad_per_s);
  for (long i = std::lround(time_s / tick_s); i > 0; --i)
    heat.step(heating_W, heating_W, heating_W);
  return heat.hottest_K();
}

/// A thermometer reading at 2 W.
board::ThermalFacts read_at_2_W() {
  board::ThermalFacts facts;
  facts.steady_rise_K = 22.5;
  facts.steady_error_K = 1.0;
  facts.steady_min_W = 1.98;
  facts.steady_max_W = 2.02;
  return facts;
}

}  // namespace

TEST_GROUP(HotEnd) {
  ThermalSettings settings;
  double slowest_pole = -settings.bounds.min_transfer_W_per_K / settings.bounds.max_mass_J_per_K;
  double fastest_pole = -settings.bounds.max_transfer_W_per_K / settings.bounds.min_mass_J_per_K;
};

TEST(HotEnd, LearnedCoolingIsLimitedToTheConfiguredBounds) {
  const double rest_K = heating_W / (-slowest_pole * settings.thermal_mass_J_per_K);
  for (const double absurd : {-1e-9, 0.01 * slowest_pole, slowest_pole})
    DOUBLES_EQUAL(rest_K, hottest_after_K(settings, absurd, 60.0), 0.01);
}

TEST(HotEnd, IsTheHotterOfConfiguredAndLearned) {
  const double configured_K = heating_W / settings.bounds.min_transfer_W_per_K;
  DOUBLES_EQUAL(configured_K, hottest_after_K(settings, fastest_pole, 60.0), 0.01);
  DOUBLES_EQUAL(configured_K, hottest_after_K(settings, 100.0 * fastest_pole, 60.0), 0.01);
  const double slower_pole = 1.05 * slowest_pole;
  DOUBLES_EQUAL(heating_W / (-slower_pole * settings.thermal_mass_J_per_K),
                hottest_after_K(settings, slower_pole, 60.0), 0.01);
}

TEST(HotEnd, AnotherMuscleForgetsTheLearnedCooling) {
  Heat heat(settings, {}, tick_s);
  heat.learn(slowest_pole);
  const auto rest_K = [&] {
    for (long i = std::lround(60.0 / tick_s); i > 0; --i)
      heat.step(heating_W, heating_W, heating_W);
    return heat.hottest_K();
  };
  const double configured_K = heating_W / settings.bounds.min_transfer_W_per_K;
  CHECK_COMPARE(rest_K(), >, 1.1 * configured_K);
  heat.set_muscle({});
  DOUBLES_EQUAL(configured_K, rest_K(), 0.01);
}

TEST(HotEnd, AtBootSpansUpToTheConfiguredRise) {
  Heat heat(settings, {}, tick_s);
  DOUBLES_EQUAL(settings.air.warmest_C + settings.boot_rise_K, heat.hottest_C(), 1e-9);
  DOUBLES_EQUAL(settings.air.coldest_C, heat.coldest_C(), 1e-9);
  for (const double expected_m : heat.expected_m())
    DOUBLES_EQUAL(0.0, expected_m, 0.0);
}

TEST(HotEnd, ColdEndAndExpectedMotionUseTheirOwnPowers) {
  const control::PhysicalParameters muscle;
  Heat heat(settings, muscle, tick_s);
  for (int i = 0; i < 120'000; ++i)
    heat.step(1.0, 3.0, 2.0);
  DOUBLES_EQUAL(1.0 / settings.bounds.max_transfer_W_per_K, heat.coldest_K(), 0.01);
  DOUBLES_EQUAL(3.0 / settings.bounds.min_transfer_W_per_K, heat.hottest_K(), 0.01);
  const double metres_per_K = muscle.force_per_kelvin_N_per_K / muscle.stiffness_N_per_m;
  DOUBLES_EQUAL(2.0 * muscle.dc_gain_m_per_W(), heat.expected_m()[0], 1e-5);
  DOUBLES_EQUAL(2.0 / settings.bounds.max_transfer_W_per_K * metres_per_K, heat.expected_m()[1],
                1e-5);
  DOUBLES_EQUAL(2.0 / settings.bounds.min_transfer_W_per_K * metres_per_K, heat.expected_m()[2],
                1e-5);
}

TEST(HotEnd, ExpectedMotionUsesThePresentMuscle) {
  Heat heat(settings, {}, tick_s);
  control::PhysicalParameters found;
  found.thermal_mass_J_per_K = 0.15;
  found.heat_transfer_W_per_K = 0.1;
  found.stiffness_N_per_m = 40.0;
  heat.set_muscle(found);
  for (int i = 0; i < 120'000; ++i)
    heat.step(1.0, 3.0, 2.0);
  const double metres_per_K = found.force_per_kelvin_N_per_K / found.stiffness_N_per_m;
  DOUBLES_EQUAL(metres_per_K, heat.metres_per_K(), 0.0);
  DOUBLES_EQUAL(2.0 * found.dc_gain_m_per_W(), heat.expected_m()[0], 1e-5);
  DOUBLES_EQUAL(2.0 / settings.bounds.max_transfer_W_per_K * metres_per_K, heat.expected_m()[1],
                1e-5);
  // With the muscle's own mass: halfway after ln 2 times its time constant.
  heat.set_muscle(found);
  for (int i = 0; i < static_cast<int>(std::lround(1.5 * std::log(2.0) / tick_s)); ++i)
    heat.step(1.0, 3.0, 2.0);
  DOUBLES_EQUAL(found.dc_gain_m_per_W(), heat.expected_m()[0], 1e-5);
}

TEST(HotEnd, CountsFromTheMeasuredAir) {
  settings.air = {25.0, 15.0, 2.0};
  Heat heat(settings, {}, tick_s);
  heat.follow_air({40.0, 0.0, true, hal::Status::ok});
  DOUBLES_EQUAL(42.0 + settings.boot_rise_K, heat.hottest_C(), 1e-9);
  DOUBLES_EQUAL(heat.air().coldest_C(), heat.coldest_C(), 1e-9);
}

TEST(HotEnd, KeepsItsStateWhenTheMuscleIsReplaced) {
  Heat heat(settings, {}, tick_s);
  const board::ThermalFacts facts = read_at_2_W();
  const PowerBounds::Interval true_over_measured{0.96, 1.04};
  heat.set_thermal_facts(facts, true_over_measured);
  for (int i = 0; i < 60'000; ++i)
    heat.step(1.9, 2.1, 2.0);
  const double hottest_K = heat.hottest_K();
  const double coldest_K = heat.coldest_K();
  CHECK_COMPARE(hottest_K, <, 30.0);  // 47 K without the reading
  heat.set_thermal_facts(facts, true_over_measured);
  DOUBLES_EQUAL(hottest_K, heat.hottest_K(), 0.0);
  DOUBLES_EQUAL(coldest_K, heat.coldest_K(), 0.0);
  heat.set_thermal_facts({}, true_over_measured);
  DOUBLES_EQUAL(2.1 / settings.bounds.min_transfer_W_per_K, heat.hottest_K(), 0.01);
}

TEST(HotEnd, ByReadingIsHotterWhenPowerIsAssumedInsteadOfSensed) {
  const auto hottest_K = [&](bool sensed) {
    Heat heat(settings, {}, tick_s);
    heat.set_thermal_facts(read_at_2_W(), {0.8, 1.2});
    for (int i = 0; i < 60'000; ++i)
      heat.step(1.9, 2.1, 2.0, sensed);
    return heat.hottest_K();
  };
  // The reading accounts for the senses' error; assumed power may all be true.
  CHECK_COMPARE(hottest_K(false), >, 1.3 * hottest_K(true));
}

TEST(HotEnd, ByReadingStartsFromThePreviousBounds) {
  Heat heat(settings, {}, tick_s);
  for (int i = 0; i < 60'000; ++i)
    heat.step(1.9, 2.1, 2.0);
  const double before_K = heat.hottest_K();
  heat.set_thermal_facts(read_at_2_W(), {0.96, 1.04});
  DOUBLES_EQUAL(before_K, heat.hottest_K(), 1e-9);
  // Not at the boot's heat, which is long past: from there cooling would take longer.
  for (int i = 0; i < 6'000; ++i)
    heat.step(1.9, 2.1, 2.0);
  CHECK_COMPARE(heat.hottest_K(), <, 0.5 * (before_K + 25.0));
}

TEST(HotEnd, ByReadingNarrowsWithinASecondAfterAHotterBoot) {
  Heat heat(settings, {}, tick_s);
  for (int i = 0; i < 60'000; ++i)
    heat.step(1.9, 2.1, 2.0);
  const double before_K = heat.hottest_K();
  heat.set_thermal_facts(read_at_2_W(), {0.96, 1.04});
  for (int i = 0; i < 1000; ++i)
    heat.step(1.9, 2.1, 2.0);
  CHECK_COMPARE(heat.hottest_K(), <, before_K - 4.0);
}
