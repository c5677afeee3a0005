// Identification and calibration.
#include <string>

#include <CppUTest/TestHarness.h>

#include "runner/simulation.hpp"
#include "scenario/read_scenario.hpp"

using namespace supercoil;
using namespace supercoil::host_sim;

namespace {

/// What a run learned.
std::optional<storage::Learned> learned(const std::string& text) {
  const auto scenario = parse_scenario(text, "modes.toml");
  if (!scenario) FAIL(config::to_text(scenario.error()).c_str());
  Simulation simulation(*scenario);
  while (!simulation.done())
    simulation.step();
  return simulation.learned();
}

const std::string identify =
    "simulation.duration_s = 65.0\noperator.wish = 'identify'\n"
    "[muscle]\nstiffness_N_per_m = 22.0\ndamping_Ns_per_m = 3.0\nthermal_mass_J_per_K = 0.2\n";
const std::string calibrate = "simulation.duration_s = 30.0\noperator.wish = 'calibrate'\n";

}  // namespace

TEST_GROUP(Modes){};

TEST(Modes, IdentifyFindsTheMuscleWithinAMinute) {
  for (const int seed : {1, 2, 3, 4, 5}) {
    const auto found = learned("simulation.seed = " + std::to_string(seed) + "\n" + identify);
    CHECK(found.has_value());
    DOUBLES_EQUAL(16.0, found->muscle.stiffness_N_per_m, 0.02 * 16.0);
    DOUBLES_EQUAL(0.162, found->muscle.thermal_mass_J_per_K, 0.03 * 0.162);
    DOUBLES_EQUAL(0.089, found->muscle.heat_transfer_W_per_K, 0.02 * 0.089);
    DOUBLES_EQUAL(2.0, found->muscle.damping_Ns_per_m, 0.04 * 2.0);
  }
}

TEST(Modes, IdentifyStoresNothingWhenTheMuscleChangesUnderway) {
  CHECK_FALSE(
      learned(identify + "[[event]]\nat_s = 50.0\nplant.stiffness_N_per_m = 11.0\n").has_value());
}

TEST(Modes, IdentifyStoresNothingWhenTheMuscleIsNotTheOneThatWasConfigured) {
  CHECK_FALSE(learned("simulation.duration_s = 65.0\noperator.wish = 'identify'\n"
                      "[muscle]\nstiffness_N_per_m = 200.0\n")
                  .has_value());
}

TEST(Modes, IdentifyStoresNothingWhenTheSensorIsTooNoisy) {
  CHECK_FALSE(learned(identify + "[sensor.position]\nnoise_rms_m = 2e-3\nresolution_bits = 10\n")
                  .has_value());
}

/// The motion is still explained, but no longer by these parameters only.
TEST(Modes, IdentifyStoresNothingWhenNoiseLeavesTheParametersOpen) {
  CHECK_FALSE(learned(identify + "[sensor.position]\nnoise_rms_m = 100e-6\n").has_value());
}

TEST(Modes, IdentifyStoresNothingWhenCommandsStop) {
  CHECK_FALSE(
      learned(identify + "[[event]]\nat_s = 30.0\ntrouble.commands_stop = true\n").has_value());
}

TEST(Modes, CalibrateFindsZeroAndColdResistance) {
  // The load pulls the resting muscle to −3.1 mm, which the sensor sees as 0: so it is raised.
  const auto found = learned(calibrate + "[plant]\nload_N = -0.05\nresistance_Ohm = 9.5\n");
  CHECK(found.has_value());
  DOUBLES_EQUAL(0.05 / 16.0, found->calibration.position_offset_m, 5e-6);
  DOUBLES_EQUAL(9.5, found->calibration.cold_resistance_Ohm, 0.05);
}

TEST(Modes, CalibrateStoresNothingWhileTheMuscleMoves) {
  CHECK_FALSE(learned(calibrate + "[[event]]\nat_s = 12.3\nplant.load_N = -0.05\n").has_value());
}
