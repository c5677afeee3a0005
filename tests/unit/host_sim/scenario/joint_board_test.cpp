// The board that [joint] makes, and what its operator commands for both muscles.
#include <CppUTest/TestHarness.h>

#include "runner/board_of.hpp"
#include "runner/simulation.hpp"
#include "unit/host_sim/support/scenarios.hpp"

using namespace supercoil;
using namespace supercoil::host_sim;
using supercoil::test::read;

TEST_GROUP(JointBoard){};

TEST(JointBoard, HasTwoChannelsThatMeasureItFromBothSides) {
  const Scenario s = read(
      "[joint]\nco_contraction_W = 0.7\nlever_m = 0.012\n[joint.antagonist]\n"
      "resistance_Ohm = 7.0\nthermal_mass_J_per_K = 0.2\n[sensor.position]\nmin_m = -0.006\n"
      "range_m = 0.009\n");
  const BoardSettings board = firmware_of(s);
  LONGS_EQUAL(1, board.joints.size());
  LONGS_EQUAL(0, board.joints[0].agonist);
  LONGS_EQUAL(1, board.joints[0].antagonist);
  DOUBLES_EQUAL(0.012, board.joints[0].lever.zero_radius_m(), 0.0);
  DOUBLES_EQUAL(0.7, board.joints[0].co_contraction_W, 0.0);
  // The default of a board whose file does not mention it.
  DOUBLES_EQUAL(0.5 * 4.5, board.joints[0].max_co_contraction_W, 1e-12);
  LONGS_EQUAL(2, board.channels.size());
  const ChannelSettings& agonist = board.channels[0];
  const ChannelSettings& antagonist = board.channels[1];
  DOUBLES_EQUAL(-agonist.position.scaling.per_count, antagonist.position.scaling.per_count, 0.0);
  DOUBLES_EQUAL(0.006, antagonist.position.scaling.offset, 0.0);
  DOUBLES_EQUAL(-agonist.supervision.min_position_m, antagonist.supervision.max_position_m, 1e-12);
  DOUBLES_EQUAL(-agonist.supervision.max_position_m, antagonist.supervision.min_position_m, 1e-12);
  DOUBLES_EQUAL(0.999 * 0.009, agonist.supervision.max_travel_m, 1e-12);
  DOUBLES_EQUAL(0.999 * 0.006, antagonist.supervision.max_travel_m, 1e-12);
  DOUBLES_EQUAL(7.0, antagonist.heater.cold_resistance_Ohm, 0.0);
  DOUBLES_EQUAL(7.0, antagonist.calibration.cold_resistance_Ohm, 0.0);
  DOUBLES_EQUAL(0.2, antagonist.thermal.thermal_mass_J_per_K, 0.0);
  DOUBLES_EQUAL(agonist.limiter.max_W, antagonist.limiter.max_W, 0.0);
}

TEST(JointBoard, TheOperatorRaisesTheCoContraction) {
  const Scenario scenario = read(
      "simulation.duration_s = 12.0\n[joint]\nco_contraction_W = 0.5\n"
      "[joint.antagonist_muscle]\nheat_transfer_W_per_K = 0.0445\n"
      "[[event]]\nat_s = 10.0\njoint.co_contraction_W = 1.0\n");
  Simulation simulation(scenario);
  const Snapshot& antagonist = simulation.loop().channel(1).snapshot();
  while (!simulation.done()) {
    const double time_s = simulation.step().time_s;
    // In watts of the antagonist, which is believed to move the joint twice as far per watt.
    if (time_s > 1.0 && time_s < 9.9) DOUBLES_EQUAL(0.25, antagonist.reference, 1e-9);
  }
  DOUBLES_EQUAL(0.5, antagonist.reference, 1e-9);
  DOUBLES_EQUAL(0.5, antagonist.demanded_W, 1e-9);
  CHECK(antagonist.mode == Mode::joint);
}

/// The default limit would be half of what they can pull with; the scenario sets what is allowed.
TEST(JointBoard, TheOperatorMaySetTheMaxCoContraction) {
  const Scenario scenario = read(
      "simulation.duration_s = 1.0\n[joint]\n"
      "[[event]]\nat_s = 0.5\njoint.co_contraction_W = 4.0\n");
  Simulation simulation(scenario);
  while (!simulation.done())
    simulation.step();
  DOUBLES_EQUAL(4.0, simulation.loop().channel(1).snapshot().reference, 1e-9);
}
