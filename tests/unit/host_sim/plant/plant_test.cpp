#include "plant/plant.hpp"

#include <CppUTest/TestHarness.h>

#include "unit/host_sim/plant/support.hpp"

using namespace supercoil;
using host_sim::Plant;
using host_sim::PlantEffects;

namespace {

constexpr double millisecond_s = 1e-3;

void heat(Plant& plant, double power_W, int ticks) {
  for (int tick = 0; tick < ticks; ++tick)
    plant.step(power_W);
}

}  // namespace

TEST_GROUP(Plant){};

TEST(Plant, WithoutEffectsMatchesTheLinearPlantToTheBit) {
  host_sim::LinearPlant exact({}, millisecond_s);
  Plant plant({}, {}, millisecond_s);
  CHECK(plant.linear());
  for (int tick = 0; tick < 5000; ++tick) {
    const double power_W = tick % 700 < 350 ? 4.0 : 0.5;
    exact.step(power_W, 0.01);
    plant.step(power_W, 0.01);
  }
  DOUBLES_EQUAL(exact.temperature_rise_K(), plant.temperature_rise_K(), 0.0);
  DOUBLES_EQUAL(exact.position_m(), plant.position_m(), 0.0);
  DOUBLES_EQUAL(exact.velocity_m_per_s(), plant.velocity_m_per_s(), 0.0);
  DOUBLES_EQUAL(exact.peak_temperature_rise_K(), plant.peak_temperature_rise_K(), 0.0);
}

TEST(Plant, KeepsItsStateWhenAnEffectIsAdded) {
  Plant plant({}, {}, millisecond_s);
  heat(plant, 4.0, 3000);
  heat(plant, 0.0, 500);
  const double rise_K = plant.temperature_rise_K();
  const double peak_K = plant.peak_temperature_rise_K();
  const double position_m = plant.position_m();
  const double velocity_m_per_s = plant.velocity_m_per_s();
  CHECK_COMPARE(peak_K, >, rise_K + 1.0);
  plant.set({}, test::real_muscle());
  CHECK_FALSE(plant.linear());
  DOUBLES_EQUAL(rise_K, plant.temperature_rise_K(), 0.0);
  DOUBLES_EQUAL(peak_K, plant.peak_temperature_rise_K(), 0.0);
  DOUBLES_EQUAL(position_m, plant.position_m(), 0.0);
  DOUBLES_EQUAL(velocity_m_per_s, plant.velocity_m_per_s(), 0.0);
}

TEST(Plant, KeepsItsStateWhenAnEffectChanges) {
  Plant plant({}, test::real_muscle(), millisecond_s);
  heat(plant, 4.0, 3000);
  Plant other = plant;
  other.set({}, test::real_muscle());
  heat(plant, 1.0, 1000);
  heat(other, 1.0, 1000);
  DOUBLES_EQUAL(plant.position_m(), other.position_m(), 1e-12);
  PlantEffects windy = test::real_muscle();
  windy.draught_ratio = 2.0;
  other.set({}, windy);
  DOUBLES_EQUAL(plant.temperature_rise_K(), other.temperature_rise_K(), 1e-12);
  heat(plant, 1.0, 1000);
  heat(other, 1.0, 1000);
  CHECK_COMPARE(other.temperature_rise_K(), <, plant.temperature_rise_K() - 1.0);
}

TEST(Plant, SofteningActsWithAndWithoutEffects) {
  Plant plant({}, test::real_muscle(), millisecond_s);
  heat(plant, 3.0, 30000);
  const double before_m = plant.position_m();
  control::PhysicalParameters soft;
  soft.stiffness_N_per_m = 12.0;
  PlantEffects effects = test::real_muscle();
  effects.lonely_stroke_m = 0.0;
  plant.set(soft, effects);
  heat(plant, 3.0, 600000);
  Plant hard({}, effects, millisecond_s);
  heat(hard, 3.0, 600000);
  CHECK_COMPARE(plant.position_m(), >, before_m);
  DOUBLES_EQUAL(hard.position_m() * 16.0 / 12.0, plant.position_m(), 1e-6);
}
