#include "plant/nonlinear_plant.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <CppUTest/TestHarness.h>
#include <nlohmann/json.hpp>

#include "plant/linear_plant.hpp"
#include "unit/control/support/reference.hpp"
#include "unit/host_sim/plant/support.hpp"

using namespace supercoil;
using host_sim::NonlinearPlant;
using host_sim::PlantEffects;

namespace {

constexpr double tick_s = 1e-3;

}  // namespace

TEST_GROUP(NonlinearPlant){};

TEST(NonlinearPlant, AgreesWithAnIndependentSolverForEachEffectAndAllTogether) {
  const nlohmann::json cases = test::reference("muscle_effects", "cases");
  CHECK(cases.size() >= 17);
  for (const auto& c : cases) {
    const std::string name = c.at("name");
    NonlinearPlant plant(test::parameters_from(c.at("parameters")),
                         test::effects_from(c.at("effects")), tick_s);
    const test::Deviations found = test::deviations(plant, tick_s, c);
    CHECK_COMPARE_TEXT(found.temperature.relative(), <, 1e-6, name.c_str());
    CHECK_COMPARE_TEXT(found.position.relative(), <, 1e-6, name.c_str());
    CHECK_COMPARE_TEXT(found.velocity.relative(), <, 1e-5, name.c_str());
  }
}

TEST(NonlinearPlant, WithoutEffectsMatchesThePapersMuscle) {
  host_sim::LinearPlant exact({}, tick_s);
  NonlinearPlant plant({}, {}, tick_s);
  for (int tick = 0; tick < 30000; ++tick) {
    const double power_W = tick % 3000 < 1500 ? 4.5 : 0.5;
    const double load_N = tick > 20000 ? 0.05 : 0.0;
    exact.step(power_W, load_N);
    plant.step(power_W, load_N);
    DOUBLES_EQUAL(exact.temperature_rise_K(), plant.temperature_rise_K(), 1e-5);
    DOUBLES_EQUAL(exact.position_m(), plant.position_m(), 1e-8);
  }
}

TEST(NonlinearPlant, ConservesHeat) {
  for (const double draught : {1.0, 3.0}) {
    PlantEffects effects = test::real_muscle();
    effects.draught_ratio = draught;
    effects.air_change_K = 7.0;
    const control::PhysicalParameters muscle;
    NonlinearPlant plant(muscle, effects, tick_s);
    double in_J = 0.0;
    double lost_J = 0.0;
    for (int tick = 0; tick < 60000; ++tick) {
      const double power_W = tick % 5000 < 2500 ? 4.5 : 0.0;
      plant.step(power_W);
      in_J += power_W * tick_s;
      lost_J += plant.heat_loss_J();
    }
    const double stored_J = muscle.thermal_mass_J_per_K * plant.temperature_rise_K();
    DOUBLES_EQUAL(in_J, stored_J + lost_J, 1e-9 * in_J);
  }
}

TEST(NonlinearPlant, ComesToTheAirsTemperature) {
  PlantEffects effects = test::real_muscle();
  effects.air_change_K = 10.0;
  NonlinearPlant plant({}, effects, tick_s);
  for (int tick = 0; tick < 120000; ++tick)
    plant.step(0.0);
  DOUBLES_EQUAL(10.0, plant.temperature_rise_K(), 1e-6);
  CHECK_COMPARE(plant.position_m(), >, 1e-3);
}

TEST(NonlinearPlant, FirstHeatingLengthensItPermanently) {
  PlantEffects effects;
  effects.lonely_stroke_m = 0.005;
  NonlinearPlant plant({}, effects, tick_s);
  const auto cool = [&plant] {
    for (int tick = 0; tick < 60000; ++tick)
      plant.step(0.0);
    return plant.position_m();
  };
  DOUBLES_EQUAL(0.0, cool(), 1e-12);
  for (int tick = 0; tick < 1000; ++tick)
    plant.step(4.5);
  const double peak_K = plant.peak_temperature_rise_K();
  CHECK_COMPARE(peak_K, >, 10.0);
  CHECK_COMPARE(peak_K, <, 60.0);
  DOUBLES_EQUAL(-0.005 * peak_K / 60.0, cool(), 1e-9);
  for (int tick = 0; tick < 20000; ++tick)
    plant.step(8.0);
  DOUBLES_EQUAL(-0.005, cool(), 1e-9);
}

TEST(NonlinearPlant, SagsUnderItsLoadWhereItSoftens) {
  PlantEffects effects;
  effects.softening_ratio = 0.4;
  effects.hanging_mass_kg = 0.09;
  control::PhysicalParameters muscle;
  NonlinearPlant plant(muscle, effects, tick_s);
  for (int tick = 0; tick < 60000; ++tick)
    plant.step(60.0 * muscle.heat_transfer_W_per_K);
  const double force_N = muscle.force_per_kelvin_N_per_K * 60.0;
  const double expected_m = (force_N - 0.4 * 0.09 * 9.81) / (0.6 * muscle.stiffness_N_per_m);
  DOUBLES_EQUAL(expected_m, plant.position_m(), 1e-8);
}

TEST(NonlinearPlant, RestsOnItsEndStop) {
  PlantEffects effects;
  effects.end_stop_m = -0.001;
  NonlinearPlant plant({}, effects, tick_s);
  for (int tick = 0; tick < 2000; ++tick)
    plant.step(0.0, 0.5);
  DOUBLES_EQUAL(-0.001, plant.position_m(), 0.0);
  DOUBLES_EQUAL(0.0, plant.velocity_m_per_s(), 0.0);
  for (int tick = 0; tick < 20000; ++tick)
    plant.step(1.0);
  CHECK_COMPARE(plant.position_m(), >, 0.005);
}

TEST(NonlinearPlant, ReachesItsUpperEndStopAndLeavesIt) {
  PlantEffects effects;
  effects.ceiling_m = 0.003;
  NonlinearPlant plant({}, effects, tick_s);
  for (int tick = 0; tick < 20000; ++tick)
    plant.step(1.0);
  DOUBLES_EQUAL(0.003, plant.position_m(), 0.0);
  DOUBLES_EQUAL(0.0, plant.velocity_m_per_s(), 0.0);
  for (int tick = 0; tick < 20000; ++tick)
    plant.step(0.0);
  CHECK_COMPARE(plant.position_m(), <, 0.0005);
}

TEST(NonlinearPlant, TakesCoarseTicksAsWellAsFineOnes) {
  NonlinearPlant fine({}, test::real_muscle(), 1e-3);
  NonlinearPlant coarse({}, test::real_muscle(), 1e-2);
  for (int tick = 0; tick < 2000; ++tick) {
    const double power_W = tick % 300 < 150 ? 4.5 : 0.5;
    for (int i = 0; i < 10; ++i)
      fine.step(power_W);
    coarse.step(power_W);
    DOUBLES_EQUAL(fine.position_m(), coarse.position_m(), 1e-12);
  }
}

TEST(NonlinearPlant, StaysFiniteForEveryMuscleThatIsAllowed) {
  for (int corner = 0; corner < 64; ++corner) {
    control::PhysicalParameters muscle;
    int bit = 0;
    for (const control::PhysicalRange& range : control::physical_ranges)
      muscle.*range.member = (corner >> bit++ & 1) != 0 ? range.max : range.min;
    PlantEffects effects = test::real_muscle();
    effects.friction_ratio = corner % 3 == 0 ? 0.02 : 0.0;
    NonlinearPlant plant(muscle, effects, tick_s);
    for (int tick = 0; tick < 300; ++tick)
      plant.step(tick < 150 ? 5.0 : 0.0);
    CHECK(std::isfinite(plant.temperature_rise_K()));
    CHECK(std::isfinite(plant.position_m()));
    CHECK(std::isfinite(plant.velocity_m_per_s()));
  }
}
