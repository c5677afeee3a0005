#include "loop/modelled_pull.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>

using namespace supercoil;

TEST_GROUP(ModelledPull) {
  control::PhysicalParameters muscle;
  JointSettings joint;

  void setup() override {
    muscle.thermal_mass_J_per_K = 0.2;
    muscle.heat_transfer_W_per_K = 0.1;
    muscle.stiffness_N_per_m = 40.0;
    muscle.force_per_kelvin_N_per_K = 0.01;
    joint.pretension_N = 0.3;
  }
};

TEST(ModelledPull, IsPretensionAndHeatMinusItsOwnStiffness) {
  ModelledPull pull(joint.place_of(0));
  DOUBLES_EQUAL(0.3, pull.at_N(0.0, muscle), 1e-12);
  DOUBLES_EQUAL(0.3 - 20.0 * 0.01, pull.at_N(0.01, muscle), 1e-12);
  DOUBLES_EQUAL(0.3 + 20.0 * 0.01, pull.at_N(-0.01, muscle), 1e-12);
  for (int i = 0; i < 20000; ++i)
    pull.step(1.5, 1e-3, muscle);
  DOUBLES_EQUAL(1.5, pull.heat_W(), 1e-3);
  DOUBLES_EQUAL(0.3 + 0.15, pull.at_N(0.0, muscle), 1e-4);
  // After one time constant of 2 s.
  for (int i = 0; i < 2000; ++i)
    pull.step(0.0, 1e-3, muscle);
  DOUBLES_EQUAL(1.5 * std::exp(-1.0), pull.heat_W(), 1e-3);
  pull.step(2.0, 1e3, muscle);
  DOUBLES_EQUAL(2.0, pull.heat_W(), 1e-12);
}

TEST(ModelledPull, TautPowerHasATenthInReserve) {
  const ModelledPull pull(joint.place_of(0));
  DOUBLES_EQUAL((1.1 * 20.0 * 0.02 - 0.3) / 0.1, pull.taut_W(0.02, muscle), 1e-12);
  CHECK_COMPARE(pull.taut_W(0.01, muscle), <, 0.0);
}

TEST(ModelledPull, OfAMuscleWithItsOwnLeverIsInItsOwnUnits) {
  joint.antagonist_lever_ratio = 0.5;
  DOUBLES_EQUAL(0.8, joint.place_of(0).stiffness_ratio, 1e-12);
  DOUBLES_EQUAL(0.2, joint.place_of(1).stiffness_ratio, 1e-12);
  DOUBLES_EQUAL(0.6, joint.place_of(1).pretension_N, 1e-12);
  joint.stiffness_ratio = {0.25, 0.375};
  DOUBLES_EQUAL(0.25, joint.place_of(0).stiffness_ratio, 1e-12);
  DOUBLES_EQUAL(0.375, joint.place_of(1).stiffness_ratio, 1e-12);
}

TEST(ModelledPull, IsUnknownWithoutThePretension) {
  joint.pretension_N = NAN;
  const ModelledPull pull(joint.place_of(0));
  CHECK_TRUE(std::isnan(pull.at_N(0.0, muscle)) && std::isnan(pull.taut_W(0.0, muscle)));
  CHECK_FALSE(joint.place_of(0).knows_pull());
}
