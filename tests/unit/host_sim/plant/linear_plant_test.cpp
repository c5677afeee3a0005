#include "plant/linear_plant.hpp"

#include <algorithm>
#include <cmath>

#include <CppUTest/TestHarness.h>
#include <nlohmann/json.hpp>

#include "unit/control/support/reference.hpp"
#include "unit/host_sim/plant/support.hpp"

using namespace supercoil;
using host_sim::LinearPlant;

namespace {

constexpr double step_s = 1e-3;

}  // namespace

TEST_GROUP(LinearPlant){};

TEST(LinearPlant, AgreesWithAnIndependentSolverOver120Seconds) {
  const nlohmann::json cases = test::reference("plant", "cases");
  CHECK(cases.size() >= 10);
  for (const auto& c : cases) {
    LinearPlant plant(test::parameters_from(c.at("parameters")), step_s);
    const test::Deviations found = test::deviations(plant, step_s, c);
    CHECK_COMPARE(found.temperature.relative(), <, 1e-6);
    CHECK_COMPARE(found.position.relative(), <, 1e-6);
    CHECK_COMPARE(found.velocity.relative(), <, 1e-6);
  }
}

TEST(LinearPlant, GivesTheSameWithAnyNumberOfSubsteps) {
  LinearPlant coarse({}, step_s, 1);
  LinearPlant fine({}, step_s, 10);
  for (int tick = 0; tick < 5000; ++tick) {
    const double power = tick % 700 < 350 ? 4.0 : 0.5;
    coarse.step(power);
    fine.step(power);
    DOUBLES_EQUAL(coarse.position_m(), fine.position_m(), 1e-13);
  }
  CHECK_COMPARE(fine.peak_temperature_rise_K(), >=, coarse.peak_temperature_rise_K() - 1e-9);
}

TEST(LinearPlant, SettlesWhereItsDcGainSays) {
  const control::PhysicalParameters p;
  LinearPlant plant(p, step_s);
  for (int tick = 0; tick < 60000; ++tick)
    plant.step(4.5);
  DOUBLES_EQUAL(4.5 * p.dc_gain_m_per_W(), plant.position_m(), 1e-9);
  DOUBLES_EQUAL(0.02718, plant.position_m(), 1e-5);
  DOUBLES_EQUAL(50.56, plant.temperature_rise_K(), 0.01);
}

TEST(LinearPlant, KeepsTemperatureAndMotionWhenItsParametersChange) {
  control::PhysicalParameters p;
  LinearPlant plant(p, step_s);
  for (int tick = 0; tick < 3000; ++tick)
    plant.step(3.0);
  const double temperature = plant.temperature_rise_K();
  const double position = plant.position_m();
  p.stiffness_N_per_m = 12.0;
  plant.set_parameters(p);
  DOUBLES_EQUAL(temperature, plant.temperature_rise_K(), 0.0);
  DOUBLES_EQUAL(position, plant.position_m(), 0.0);
  for (int tick = 0; tick < 60000; ++tick)
    plant.step(3.0);
  DOUBLES_EQUAL(3.0 * p.dc_gain_m_per_W(), plant.position_m(), 1e-9);
}

TEST(LinearPlant, IsExtendedByALoad) {
  const control::PhysicalParameters p;
  LinearPlant plant(p, step_s);
  for (int tick = 0; tick < 60000; ++tick)
    plant.step(2.0, 0.05);
  DOUBLES_EQUAL(2.0 * p.dc_gain_m_per_W() - 0.05 / p.stiffness_N_per_m, plant.position_m(), 1e-9);
}
