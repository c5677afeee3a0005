// [joint]: how it is read, and the runs that it makes.
#include <cmath>
#include <numbers>
#include <string>

#include <CppUTest/TestHarness.h>
#include <nlohmann/json.hpp>

#include "runner/board_of.hpp"
#include "runner/summary.hpp"
#include "unit/host_sim/support/scenarios.hpp"

using namespace supercoil;
using namespace supercoil::host_sim;
using supercoil::test::problems;
using supercoil::test::read;

namespace {

void check_joint_answer(const char* expected, const std::string& text) {
  STRCMP_EQUAL((std::string("s.toml:") + expected + "\n").c_str(), problems(text).c_str());
}

TickRecord last_of(Simulation& simulation, Summary& summary) {
  TickRecord record;
  while (!simulation.done()) {
    record = simulation.step();
    summary.add(record);
  }
  return record;
}

}  // namespace

TEST_GROUP(JointScenario){};

TEST(JointScenario, IsPresentOnlyWithItsTable) {
  CHECK_FALSE(read("").start.joint.has_value());
  CHECK(read("[joint]").start.joint.has_value());
}

TEST(JointScenario, TheBoardKnowsBothMusclesAndTheLever) {
  const Scenario s = read(
      "[joint]\nlever_m = 0.02\ninertia_kg_m2 = 4e-5\nspring_Nm_per_rad = 0.004\n"
      "damping_Nms_per_rad = 0.0002\n[joint.antagonist]\nstiffness_N_per_m = 20.0\n"
      "thermal_mass_J_per_K = 0.2\n");
  const control::PhysicalParameters& agonist = s.start.muscle;
  const control::PhysicalParameters& antagonist = s.start.antagonist()->muscle;
  for (const control::PhysicalParameters* muscle : {&agonist, &antagonist}) {
    DOUBLES_EQUAL(16.0 + 20.0 + 10.0, muscle->stiffness_N_per_m, 1e-9);
    DOUBLES_EQUAL(2.0 + 2.0 + 0.5, muscle->damping_Ns_per_m, 1e-9);
    DOUBLES_EQUAL(0.1, muscle->moving_mass_kg, 1e-12);
  }
  DOUBLES_EQUAL(0.162, agonist.thermal_mass_J_per_K, 0.0);
  DOUBLES_EQUAL(0.2, antagonist.thermal_mass_J_per_K, 0.0);
}

TEST(JointScenario, AntagonistMuscleKeysOverrideTheMuscleTable) {
  const Scenario s = read(
      "[muscle]\nstiffness_N_per_m = 30.0\nheat_transfer_W_per_K = 0.1\n[joint]\n"
      "[joint.antagonist_muscle]\nstiffness_N_per_m = 40.0\n");
  DOUBLES_EQUAL(30.0, s.start.muscle.stiffness_N_per_m, 0.0);
  DOUBLES_EQUAL(40.0, s.start.antagonist()->muscle.stiffness_N_per_m, 0.0);
  DOUBLES_EQUAL(0.1, s.start.antagonist()->muscle.heat_transfer_W_per_K, 0.0);
  DOUBLES_EQUAL(4.0, s.start.antagonist()->muscle.damping_Ns_per_m, 0.0);
}

TEST(JointScenario, TheAntagonistEqualsTheAgonistExceptForItsKeys) {
  const Scenario s = read(
      "[plant]\npreset = 'real'\nresistance_Ohm = 8.0\n[joint]\n[joint.antagonist]\n"
      "creep_ratio = 0.2\n");
  PlantSettings expected = s.start.plant;
  expected.effects.creep_ratio = 0.2;
  CHECK(expected == s.start.antagonist()->plant);
}

TEST(JointScenario, SensorAndReferenceExtendToBothSides) {
  const Conditions c = read("[joint]").start;
  DOUBLES_EQUAL(-0.008, c.position_sensor.min_m, 0.0);
  DOUBLES_EQUAL(0.008, c.position_sensor.range_m, 0.0);
  DOUBLES_EQUAL(-0.005, c.reference.min(), 1e-12);
  DOUBLES_EQUAL(0.005, c.reference.max(), 1e-12);
  DOUBLES_EQUAL(
      -0.012, read("[joint]\n[sensor.position]\nrange_m = 0.012").start.position_sensor.min_m, 0.0);
}

TEST(JointScenario, AnEventMayChangeLoadsDampingAndTheAntagonist) {
  const Scenario s = read(
      "[joint]\n[[event]]\nat_s = 1.0\njoint.load_Nm = 0.002\njoint.weight_Nm = 0.001\n"
      "joint.damping_Nms_per_rad = 0.0001\njoint.antagonist.stiffness_N_per_m = 12.0\n");
  const JointConditions& joint = *s.events[0].conditions.joint;
  DOUBLES_EQUAL(0.002, joint.load_Nm, 0.0);
  DOUBLES_EQUAL(0.001, joint.plant.weight_Nm, 0.0);
  DOUBLES_EQUAL(0.0001, joint.plant.damping_Nms_per_rad, 0.0);
  DOUBLES_EQUAL(12.0, joint.antagonist->plant.parameters.stiffness_N_per_m, 0.0);
  DOUBLES_EQUAL(32.0, s.events[0].conditions.muscle.stiffness_N_per_m, 0.0);
}

TEST(JointScenario, ErrorsNameWhatIsAllowed) {
  check_joint_answer("2: joint.lever_m = 2: must be 0.001 to 1", "[joint]\nlever_m = 2.0");
  check_joint_answer("2: joint.co_contraction_W = 5: must be 0 to 4.5",
                     "[joint]\nco_contraction_W = 5.0");
  check_joint_answer(
      "2: joint.lever = 0.01: is not a key of [joint]; did you mean lever_m (the unit is part of "
      "the name)?",
      "[joint]\nlever = 0.01");
  check_joint_answer("2: joint.antagonist.force_ratio = 50: must be 0.1 to 20",
                     "[joint]\nantagonist.force_ratio = 50.0");
  check_joint_answer("2: joint.antagonist_muscle.stiffness_N_per_m = -1: must be 0.01 to 1e+06",
                     "[joint]\nantagonist_muscle.stiffness_N_per_m = -1.0");
  check_joint_answer(
      "2: plant.load_N = 0.1: is for a single muscle; with a [joint] set joint.load_Nm",
      "[plant]\nload_N = 0.1\n[joint]\n");
  check_joint_answer("1: joint = 3: must be a table: [joint]", "joint = 3");
  check_joint_answer("3: sensor.position.min_m = 0: must be -10 to -0.0001",
                     "[joint]\n[sensor.position]\nmin_m = 0.0");
  check_joint_answer(
      "1: joint: makes muscle.moving_mass_kg = 10000, which must be 1e-05 to 1000\n"
      "s.toml:1: joint: makes joint.antagonist_muscle.moving_mass_kg = 10000, which must be 1e-05 "
      "to 1000",
      "[joint]\nlever_m = 0.1\ninertia_kg_m2 = 100.0");
}

TEST(JointScenario, LearnedValuesOfEitherMuscleAreUsed) {
  const std::string text = "[joint]\nantagonist.resistance_Ohm = 7.0\n";
  LearnedMuscles learned;
  learned[1].emplace();
  learned[1]->muscle = read(text).start.antagonist()->muscle;
  learned[1]->muscle.stiffness_N_per_m = 27.0;
  learned[1]->calibration.cold_resistance_Ohm = 7.5;
  learned[1]->response_ratio = 0.8;
  learned[1]->unexplained_ratio = 0.02;
  learned[1]->identification = {{0.0, 0.2, 0.1, 0.05}, 1795219200.0};
  const auto known = parse_scenario(text, "s.toml", learned);
  CHECK(known.has_value());
  const BoardSettings board = firmware_of(*known);
  DOUBLES_EQUAL(32.0, board.channels[0].muscle.stiffness_N_per_m, 0.0);
  CHECK_FALSE(board.channels[0].muscle_identified);
  DOUBLES_EQUAL(27.0, board.channels[1].muscle.stiffness_N_per_m, 0.0);
  CHECK(board.channels[1].muscle_identified);
  DOUBLES_EQUAL(7.5, board.channels[1].calibration.cold_resistance_Ohm, 0.0);
  DOUBLES_EQUAL(7.0, board.channels[1].heater.cold_resistance_Ohm, 0.0);
  DOUBLES_EQUAL(0.8, board.channels[1].response_ratio, 0.0);
  DOUBLES_EQUAL(0.02, board.channels[1].unexplained_ratio, 0.0);
  CHECK(board.channels[1].identification == learned[1]->identification);
}

TEST(JointScenario, ItsLeverMayDependOnTheAngle) {
  const Scenario s =
      read("[joint]\nlever_m = [0.012, 0.015, 0.012]\nlever_range_deg = [-30.0, 30.0]\n");
  const control::Lever& lever = s.start.joint->plant.lever;
  DOUBLES_EQUAL(0.015, lever.zero_radius_m(), 1e-12);
  CHECK(firmware_of(s).joints[0].lever == lever);
  // The muscles move an inertia at the lever of angle 0.
  DOUBLES_EQUAL(s.start.joint->plant.inertia_kg_m2 / (0.015 * 0.015), s.start.muscle.moving_mass_kg,
                1e-12);
  check_joint_answer(
      "2: joint.lever_m = [0.01, 0.02]: needs lever_range_deg, the angles of its first and its "
      "last lever",
      "[joint]\nlever_m = [0.01, 0.02]");
}

TEST(JointScenario, AgainstASpringTheLeverMayDependOnTheAngleToo) {
  const Scenario s = read(
      "simulation.duration_s = 20.0\n[joint]\nopposed_by = 'spring'\nspring_Nm_per_rad = 0.006\n"
      "pretension_N = 0.3\nlever_m = [0.015, 0.015, 0.012]\nlever_range_deg = [-40.0, 40.0]\n"
      "[reference]\nkind = 'step'\nto_m = 0.005\n[controller]\nkind = 'pi'\n");
  const control::Lever& lever = s.start.joint->plant.lever;
  CHECK(firmware_of(s).channels[0].joint.lever == lever);

  Simulation simulation(s);
  Summary summary({});
  const TickRecord last = last_of(simulation, summary);
  CHECK(last.fault == Fault::none);
  DOUBLES_EQUAL(0.005, last.position_m, 1e-4);
  const double angle_rad = simulation.joint()->angle_rad();
  DOUBLES_EQUAL(lever.arc_m(angle_rad), last.position_m, 1e-9);
  // At rest the muscle's pull at that lever balances the spring, which holds the pretension at 0.
  const double pull_N =
      s.start.joint->plant.pretension_N + 8.6e-3 * last.temperature_rise_K - 16.0 * last.position_m;
  const double spring_Nm = 0.006 * angle_rad + s.start.joint->plant.pretension_N * 0.015;
  DOUBLES_EQUAL(spring_Nm, pull_N * lever.radius_m(angle_rad), 0.02 * spring_Nm);
}

TEST(JointScenario, AMistakeInPlantIsReportedOnce) {
  check_joint_answer("2: plant.force_ratio = 50: must be 0.1 to 20",
                     "[plant]\nforce_ratio = 50.0\n[joint]\nantagonist.creep_ratio = 0.1\n");
}

TEST(JointScenario, AnUnreachableReferenceIsRefused) {
  check_joint_answer(
      "2: reference.kind (its default): the reference goes from 0 to 10 mm, but sensor.position "
      "and the joint's end stops allow -7.992 to 7.992 mm",
      "[joint]\n[reference]\noffset_m = 0.005\n");
}

TEST(JointScenario, FixedHardwareCannotChange) {
  check_joint_answer("4: event.joint.lever_m: cannot change during a run",
                     "[joint]\n[[event]]\nat_s = 1.0\njoint.lever_m = 0.02");
  check_joint_answer(
      "4: event.joint.lever_m: cannot change during a run\n"
      "s.toml:5: event.joint.lever_range_deg: cannot change during a run",
      "[joint]\n[[event]]\nat_s = 1.0\njoint.lever_m = [0.02, 0.03]\n"
      "joint.lever_range_deg = [-1.0, 1.0]");
  check_joint_answer("3: event.joint: needs a [joint] from the start",
                     "[[event]]\nat_s = 1.0\njoint.load_Nm = 0.02");
}

TEST(JointScenario, ItsFaultsNeedAJoint) {
  CHECK(read("[joint]\n[injected_fault]\nantagonist_torn = true")
            .start.injected_faults.antagonist_torn);
  check_joint_answer("2: injected_fault.agonist_torn = true: needs a [joint]",
                     "[injected_fault]\nagonist_torn = true");
  DOUBLES_EQUAL(0.003,
                read("[joint]\n[injected_fault]\nagonist_slack_m = 0.003")
                    .start.injected_faults.agonist_slack_m,
                0.0);
  check_joint_answer("2: injected_fault.antagonist_slack_m = 0.003: needs a [joint]",
                     "[injected_fault]\nantagonist_slack_m = 0.003");
  check_joint_answer("3: injected_fault.antagonist_slack_m = -0.1: must be 0 to 1",
                     "[joint]\n[injected_fault]\nantagonist_slack_m = -0.1");
}

TEST(JointScenario, ASpringOpposesOneMuscle) {
  const Scenario s = read(
      "simulation.duration_s = 20.0\n[joint]\nopposed_by = 'spring'\nspring_Nm_per_rad = 0.009\n"
      "[reference]\nkind = 'step'\nto_m = 0.004\n[controller]\nkind = 'pi'\n"
      "[[event]]\nat_s = 10.0\njoint.load_Nm = 0.0005\n");
  DOUBLES_EQUAL(16.0 + 40.0, s.start.muscle.stiffness_N_per_m, 1e-9);
  DOUBLES_EQUAL(2.0, s.start.muscle.damping_Ns_per_m, 0.0);
  DOUBLES_EQUAL(2e-5 / (0.015 * 0.015), s.start.muscle.moving_mass_kg, 1e-12);
  const BoardSettings board = firmware_of(s);
  LONGS_EQUAL(1, board.channels.size());
  LONGS_EQUAL(0, board.joints.size());

  Simulation simulation(s);
  Summary summary({});
  const TickRecord last = last_of(simulation, summary);
  CHECK(last.fault == Fault::none);
  CHECK_FALSE(last.antagonist.has_value());
  DOUBLES_EQUAL(0.004, last.position_m, 1e-4);
  DOUBLES_EQUAL(last.position_m, simulation.joint()->position_m(), 0.0);
  // At rest the muscle's heat balances the spring, its own stiffness and the load.
  const double force_N = 56.0 * last.position_m + 0.0005 / 0.015;
  DOUBLES_EQUAL(force_N, 8.6e-3 * last.temperature_rise_K, 0.02 * force_N);
}

TEST(JointScenario, AWeightOpposesOneMuscle) {
  const Scenario s = read(
      "simulation.duration_s = 30.0\n[joint]\nopposed_by = 'gravity'\nweight_Nm = 0.004\n"
      "hangs_at_deg = -60.0\n[reference]\nkind = 'step'\nto_m = 0.004\n[controller]\nkind = 'pi'\n"
      "[[event]]\nat_s = 15.0\njoint.weight_Nm = 0.005\n");
  constexpr double lever2 = 0.015 * 0.015;
  DOUBLES_EQUAL(16.0 + 0.004 * 0.5 / lever2, s.start.muscle.stiffness_N_per_m, 1e-5);
  const double hangs_at_rad = -std::numbers::pi / 3.0;
  const BoardSettings board = firmware_of(s);
  LONGS_EQUAL(1, board.channels.size());
  DOUBLES_EQUAL(0.004, board.channels[0].joint.weight_Nm, 0.0);
  DOUBLES_EQUAL(hangs_at_rad, board.channels[0].joint.hangs_at_rad, 1e-12);

  Simulation simulation(s);
  Summary summary({});
  const TickRecord last = last_of(simulation, summary);
  CHECK(last.fault == Fault::none);
  DOUBLES_EQUAL(0.004, last.position_m, 1e-4);
  // The heavier arm pulls harder than the cold muscle's stretch did at 0, by more than the angle's.
  const double angle_rad = last.position_m / 0.015;
  const double force_N =
      16.0 * last.position_m +
      (0.005 * std::sin(angle_rad - hangs_at_rad) - 0.004 * std::sin(-hangs_at_rad)) / 0.015;
  DOUBLES_EQUAL(force_N, 8.6e-3 * last.temperature_rise_K, 0.02 * force_N);
}

TEST(JointScenario, KeysOfOtherJointsAreRefusedWithAWeight) {
  const std::string gravity = "[joint]\nopposed_by = 'gravity'\n";
  check_joint_answer(
      "3: joint.pretension_N = 0.3: follows from weight_Nm, hangs_at_deg and lever_m; remove it",
      gravity + "pretension_N = 0.3");
  check_joint_answer("3: joint.weight_Nm = 0: must be 1e-06 to 100", gravity + "weight_Nm = 0.0");
  check_joint_answer("2: joint.hangs_at_deg = -30: needs [joint] opposed_by = \"gravity\"",
                     "[joint]\nhangs_at_deg = -30.0");
  check_joint_answer("5: event.joint.hangs_at_deg: cannot change during a run",
                     gravity + "[[event]]\nat_s = 1.0\njoint.hangs_at_deg = -30.0");
}

TEST(JointScenario, ItsBoardPublishesTheLeverOfAJointAgainstASpring) {
  const Scenario scenario =
      read("simulation.duration_s = 0.1\n[joint]\nopposed_by = 'spring'\nlever_m = 0.012\n");
  Simulation simulation(scenario);
  const Channel& channel = simulation.loop().channel(0);
  DOUBLES_EQUAL(0.012, channel.known(known_joint_lever), 0.0);
  CHECK(std::isnan(channel.known(known_joint_other_node_offset)));
}

TEST(JointScenario, KeysOfTwoMusclesAreRefusedWithASpring) {
  const std::string spring = "[joint]\nopposed_by = 'spring'\n";
  const std::string needs = ": needs [joint] opposed_by = \"muscle\"";
  check_joint_answer(("3: joint.co_contraction_W = 1" + needs).c_str(),
                     spring + "co_contraction_W = 1.0");
  check_joint_answer(("3: joint.antagonist" + needs).c_str(),
                     spring + "[joint.antagonist]\nstiffness_N_per_m = 20.0");
  check_joint_answer(("4: injected_fault.antagonist_torn = true" + needs).c_str(),
                     spring + "[injected_fault]\nantagonist_torn = true");
  check_joint_answer(
      "4: reference.kind = 'step': the reference goes from -5 to 5 mm, but sensor.position and "
      "the joint's end stops allow 0 to 10.989 mm",
      spring + "[reference]\nkind = 'step'\nfrom_m = -0.005");
  check_joint_answer("3: joint.spring_Nm_per_rad = 0: must be 1e-06 to 1000",
                     spring + "spring_Nm_per_rad = 0.0");
  check_joint_answer("4: event.joint.opposed_by: cannot change during a run",
                     "[joint]\n[[event]]\nat_s = 1.0\njoint.opposed_by = 'spring'");
}

TEST(JointScenario, ASlackCableByAnEventTurnsItByHalf) {
  const Scenario s = read(
      "simulation.duration_s = 10.0\noperator.action = 'disarm'\n[joint]\n[[event]]\nat_s = 1.0\n"
      "injected_fault.antagonist_slack_m = 0.003\n");
  Simulation simulation(s);
  Summary summary({});
  last_of(simulation, summary);
  DOUBLES_EQUAL(0.5 * 0.003, simulation.joint()->position_m(), 1e-6);
}

TEST(JointScenario, ItsRecordsHaveTheAntagonist) {
  const Scenario without = read("simulation.duration_s = 0.01");
  CHECK_FALSE(Simulation(without).step().antagonist.has_value());
  const Scenario s = read("simulation.duration_s = 5.0\n[joint]\n");
  Simulation simulation(s);
  Summary summary({});
  const TickRecord record = last_of(simulation, summary);
  CHECK(record.antagonist.has_value());
  CHECK(std::isfinite(record.antagonist->applied_power_W));
  CHECK_COMPARE(record.antagonist->coldest_K, <=, record.antagonist->hottest_K);
  LONGS_EQUAL(0, summary.outside_interval_ticks());
  DOUBLES_EQUAL(simulation.joint()->position_m(), record.position_m, 0.0);
  DOUBLES_EQUAL(record.position_m, record.measured_m, 1e-4);
  const auto json = summary.to_json(s, std::nullopt, simulation, 1.0);
  DOUBLES_EQUAL(json["tracking_max_m"].get<double>() / 0.015 * 180.0 / std::numbers::pi,
                json["tracking_max_deg"].get<double>(), 1e-12);
  CHECK_COMPARE(json["hottest_temperature_rise_K"].get<double>(), >=,
                record.antagonist->temperature_rise_K);
}

TEST(JointScenario, ATornMuscleLetsTheOtherTurnIt) {
  for (const bool agonist : {true, false}) {
    const Scenario s = read(std::string("simulation.duration_s = 10.0\noperator.action = 'disarm'\n"
                                        "[joint]\n[[event]]\nat_s = 1.0\ninjected_fault.") +
                            (agonist ? "agonist_torn" : "antagonist_torn") + " = true\n");
    Simulation simulation(s);
    Summary summary({});
    last_of(simulation, summary);
    DOUBLES_EQUAL(agonist ? -std::numbers::pi / 4.0 : std::numbers::pi / 4.0,
                  simulation.joint()->angle_rad(), 1e-12);
  }
}

TEST(JointScenario, ALoadByAnEventTurnsIt) {
  const Scenario s = read(
      "simulation.duration_s = 10.0\noperator.action = 'disarm'\n[joint]\n[[event]]\nat_s = 1.0\n"
      "joint.load_Nm = 0.001\njoint.antagonist.stiffness_N_per_m = 24.0\n");
  Simulation simulation(s);
  Summary summary({});
  last_of(simulation, summary);
  DOUBLES_EQUAL(-0.001 / (0.015 * 0.015 * 40.0), simulation.joint()->angle_rad(), 1e-6);
}
