// The lever of a joint in a board's file: one radius, or a table over the angle.
#include <string>

#include <CppUTest/TestHarness.h>

#include "config/describe.hpp"
#include "unit/firmware/io/config/support/checked_board.hpp"
#include "unit/firmware/io/config/support/joint_board.hpp"

using namespace supercoil;
using namespace supercoil::config;
using supercoil::test::board_with_joint;
using supercoil::test::check_answer;
using supercoil::test::read_board;
using supercoil::test::replaced;

TEST_GROUP(JointLeverConfig){};

TEST(JointLeverConfig, ALeverMayDependOnTheAngle) {
  const BoardConfig c =
      read_board(replaced(board_with_joint, "lever_m = 0.015\n",
                          "lever_m = [0.012, 0.016, 0.014]\nlever_range_deg = [-40, 40.0]\n"));
  const control::Lever& lever = c.settings.joints[0].lever;
  DOUBLES_EQUAL(0.014, lever.radius_m(-20.0 * 3.14159265358979 / 180.0), 1e-12);
  DOUBLES_EQUAL(0.016, lever.zero_radius_m(), 1e-12);
  CHECK(c.settings.channels[0].joint.lever == lever && c.settings.channels[1].joint.lever == lever);
  LONGS_EQUAL(-1, c.settings.channels[1].joint.direction);
  const std::string text = describe(c);
  for (const char* part :
       {"lever of 12 to 16 mm over -40° to 40°; 16 mm at 0°",
        "16 N/m at the lever of 0°, 0.002304 to 0.004096 Nm/rad, however much both pull: linear "
        "muscles without a load\n"})
    STRCMP_CONTAINS(part, text.c_str());
}

TEST(JointLeverConfig, AnInvalidLeverIsNamed) {
  const auto check_lever = [](const std::string& part, const std::string& lines) {
    check_answer(part, replaced(board_with_joint, "lever_m = 0.015\n", lines));
  };
  check_lever(
      "joint[1].lever_m = [0.012, 0.016]: needs lever_range_deg, the angles of its first and its "
      "last lever",
      "lever_m = [0.012, 0.016]\n");
  check_lever("joint[1].lever_range_deg = [-40, 40]: needs lever_m to be a list",
              "lever_m = 0.012\nlever_range_deg = [-40.0, 40.0]\n");
  check_lever(
      "joint[1].lever_range_deg = [10, 40]: must be two angles, with 0 between them or equal to "
      "one of them",
      "lever_m = [0.012, 0.016]\nlever_range_deg = [10.0, 40.0]\n");
  check_lever(
      "joint[1].lever_range_deg = [0, 0]: must be two angles, with 0 between them or equal to one "
      "of them",
      "lever_m = [0.012, 0.016]\nlever_range_deg = [0.0, 0.0]\n");
  check_lever(
      "joint[1].lever_m = [0.012, 0]: must be a list of 2 to 7 numbers, each 0.0001 to 1; 0 is not",
      "lever_m = [0.012, 0]\nlever_range_deg = [-40.0, 40.0]\n");
  check_lever(
      "joint[1].lever_m = [0.01, 0.01, 0.01, 0.01, 0.01, 0.01, 0.01, 0.01]: must be a list of 2 to "
      "7 numbers, each 0.0001 to 1",
      "lever_m = [0.01, 0.01, 0.01, 0.01, 0.01, 0.01, 0.01, 0.01]\nlever_range_deg = [-40.0, "
      "40.0]\n");
  check_lever("joint[1].lever_m = 'long': must be a number, 0.0001 to 1", "lever_m = 'long'\n");
}

TEST(JointLeverConfig, TheSensorMustCoverTheContractionAtItsLever) {
  const auto with_lever = [](const std::string& levers, const std::string& travel_m) {
    const std::string board =
        replaced(board_with_joint, "lever_m = 0.015\n",
                 "lever_m = " + levers + "\nlever_range_deg = [-40.0, 40.0]\n");
    return replaced(board, "max_travel_m = 0.025", "max_travel_m = " + travel_m);
  };
  // With a constant lever of 15 mm, 25 mm are read as 25 mm.
  check_answer(
      "channel[1].limits.max_travel_m = 0.025: must be within what the sensor can read: "
      "position.max_m = 0.041, and with its lever it reads 0.079351",
      with_lever("[0.015, 0.015, 0.004]", "0.025"));
  // Where the lever grows, the travel may exceed what the sensor reads.
  read_board(with_lever("[0.015, 0.015, 0.03]", "0.05"));
}
