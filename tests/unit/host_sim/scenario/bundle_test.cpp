// [bundle]: how it is read, and the boards and runs that it makes.
#include <string>

#include <CppUTest/TestHarness.h>

#include "runner/board_of.hpp"
#include "runner/summary.hpp"
#include "unit/host_sim/support/scenarios.hpp"

using namespace supercoil;
using namespace supercoil::host_sim;
using supercoil::test::problems;
using supercoil::test::read;

namespace {

void check_bundle_answer(const char* expected, const std::string& text) {
  STRCMP_EQUAL((std::string("s.toml:") + expected + "\n").c_str(), problems(text).c_str());
}

/// Followed for a while; the second muscle cools better, and the third one loses its wire.
const std::string followed =
    "[simulation]\nduration_s = 10.0\n[bundle]\nmuscles = 3\n[reference]\noffset_m = 0.008\n"
    "amplitude_m = 0.0\n";

}  // namespace

TEST_GROUP(BundleScenario){};

TEST(BundleScenario, IsPresentOnlyWithItsTable) {
  CHECK(read("").start.companions.empty());
  const Scenario two = read("[bundle]");
  UNSIGNED_LONGS_EQUAL(1, two.start.companions.size());
  LONGS_EQUAL(2, two.channels());
  LONGS_EQUAL(8, read("[bundle]\nmuscles = 8").channels());
}

TEST(BundleScenario, EachMuscleFollowsPlantExceptForItsOwnTable) {
  const Scenario s = read(
      "[plant]\npreset = \"real\"\nresistance_Ohm = 8.0\n[bundle]\nmuscles = 3\n[bundle.3]\n"
      "heat_transfer_W_per_K = 0.05\n");
  DOUBLES_EQUAL(8.0, s.start.companions[1].resistance_Ohm, 0.0);
  DOUBLES_EQUAL(0.05, s.start.companions[1].parameters.heat_transfer_W_per_K, 0.0);
  DOUBLES_EQUAL(s.start.plant.parameters.heat_transfer_W_per_K,
                s.start.companions[0].parameters.heat_transfer_W_per_K, 0.0);
  CHECK(s.start.plant.effects == s.start.companions[0].effects);
}

TEST(BundleScenario, TheBoardModelsItAsOneMuscleWithThePowerOfEach) {
  const Scenario s = read(
      "[bundle]\nmuscles = 3\n[bundle.2]\nforce_per_kelvin_N_per_K = 0.004\nstiffness_N_per_m = "
      "20.0\n");
  const BoardSettings board = firmware_of(s);
  const control::PhysicalParameters one;
  for (const ChannelSettings& channel : board.channels) {
    DOUBLES_EQUAL(2.0 * one.force_per_kelvin_N_per_K + 0.004,
                  channel.muscle.force_per_kelvin_N_per_K, 1e-12);
    DOUBLES_EQUAL(2.0 * one.stiffness_N_per_m + 20.0, channel.muscle.stiffness_N_per_m, 1e-12);
    DOUBLES_EQUAL(one.thermal_mass_J_per_K, channel.muscle.thermal_mass_J_per_K, 0.0);
    DOUBLES_EQUAL(one.moving_mass_kg, channel.muscle.moving_mass_kg, 0.0);
  }
  UNSIGNED_LONGS_EQUAL(1, board.bundles.size());
  UNSIGNED_LONGS_EQUAL(3, board.bundles[0].channels.size());
  DOUBLES_EQUAL(-2.0, board.channels[2].bundle.leader_offset, 0.0);
  CHECK(board.channels[0].supervision.proof_of_response);
  CHECK_FALSE(board.channels[1].supervision.proof_of_response);
  CHECK_FALSE(check(board).has_value());
  // Values in [muscle] take precedence.
  DOUBLES_EQUAL(30.0,
                read("[bundle]\n[muscle]\nstiffness_N_per_m = 30.0").start.muscle.stiffness_N_per_m,
                0.0);
}

TEST(BundleScenario, ErrorsNameWhatIsAllowed) {
  check_bundle_answer("2: bundle.muscles = 9: must be 2 to 8", "[bundle]\nmuscles = 9");
  check_bundle_answer("2: bundle.3: is not a key of [bundle]; its keys are: muscles, 2",
                      "[bundle]\n3.resistance_Ohm = 9.0");
  check_bundle_answer("2: bundle.2.load_N = 0.1: applies to the whole bundle: set it in [plant]",
                      "[bundle]\n2.load_N = 0.1");
  check_bundle_answer("2: bundle.2.force_ratio = 50: must be 0.1 to 20",
                      "[bundle]\n2.force_ratio = 50.0");
  check_bundle_answer(
      "2: bundle.muscles = 2: cannot be used with a [joint]: a bundle cannot be part of a joint",
      "[bundle]\nmuscles = 2\n[joint]\n");
  check_bundle_answer("2: plant.resistance_Ohm = 0.01: must be 0.1 to 10000",
                      "[plant]\nresistance_Ohm = 0.01\n[bundle]\n");
  check_bundle_answer("2: injected_fault.open_heater_in_bundle = 2: needs a [bundle]",
                      "[injected_fault]\nopen_heater_in_bundle = 2\n");
  for (const char* broken : {"4", "1.5"}) {
    check_bundle_answer(
        ("4: injected_fault.open_heater_in_bundle = " + std::string(broken) +
         ": must be the number of a muscle, 1 to 3, or 0")
            .c_str(),
        std::string("[bundle]\nmuscles = 3\n[injected_fault]\nopen_heater_in_bundle = ") + broken);
  }
  check_bundle_answer("2: event.bundle: needs a [bundle] from the start",
                      "[[event]]\nbundle.2.draught_ratio = 2.0\nat_s = 1.0");
  check_bundle_answer("4: event.bundle.muscles: cannot change during a run",
                      "[bundle]\n[[event]]\nat_s = 1.0\nbundle.muscles = 3");
}

TEST(BundleScenario, LearnedValuesOfEachMuscleAreUsed) {
  LearnedMuscles learned;
  for (const std::size_t i : {std::size_t{0}, std::size_t{2}}) {
    learned.at(i).emplace();
    learned.at(i)->muscle = read("[bundle]\nmuscles = 3").start.muscle;
    learned.at(i)->calibration.cold_resistance_Ohm = 9.0 + static_cast<double>(i);
  }
  const auto known = parse_scenario("[bundle]\nmuscles = 3", "s.toml", learned);
  const BoardSettings board = firmware_of(*known);
  DOUBLES_EQUAL(9.0, board.channels[0].calibration.cold_resistance_Ohm, 0.0);
  DOUBLES_EQUAL(10.0, board.channels[1].calibration.cold_resistance_Ohm, 0.0);
  DOUBLES_EQUAL(11.0, board.channels[2].calibration.cold_resistance_Ohm, 0.0);
}

TEST(BundleScenario, AnEventChangesOneMuscle) {
  const Scenario s =
      read(followed + "[[event]]\nat_s = 0.0\nbundle.2.heat_transfer_W_per_K = 0.15\n");
  Simulation simulation(s);
  Summary summary({0.0, 10.0});
  while (!simulation.done())
    summary.add(simulation.step());
  const TickRecord record = simulation.step();
  CHECK(record.bundle.has_value());
  CHECK_COMPARE(record.bundle->min_temperature_rise_K, <, 0.8 * record.temperature_rise_K);
  DOUBLES_EQUAL(record.temperature_rise_K, record.bundle->max_temperature_rise_K, 1e-9);
  CHECK_COMPARE(record.bundle->hottest_K, >=, record.bundle->max_temperature_rise_K);
  LONGS_EQUAL(0, summary.outside_interval_ticks());
  DOUBLES_EQUAL(0.008, record.position_m, 100e-6);
}

TEST(BundleScenario, AnyMusclesWireMayBreak) {
  for (const char* number : {"1", "3"}) {
    const Scenario s =
        read(followed + "[[event]]\nat_s = 1.0\ninjected_fault.open_heater_in_bundle = " + number);
    Simulation simulation(s);
    while (!simulation.done())
      simulation.step();
    for (std::size_t i = 0; i < 3; ++i)
      CHECK(simulation.loop().channel(i).state().first_cause() == Fault::heater_open);
  }
}
