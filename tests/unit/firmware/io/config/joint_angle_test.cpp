// Boards with a joint that is configured in degrees.
#include <string>

#include <CppUTest/TestHarness.h>

#include "config/describe.hpp"
#include "unit/firmware/io/config/support/joint_board.hpp"

using namespace supercoil;
using namespace supercoil::config;
using supercoil::test::board_with_joint;
using supercoil::test::problems_of;
using supercoil::test::replaced;
using supercoil::test::small_board_with;

namespace {

constexpr double rad_per_deg = 3.14159265358979 / 180.0;
constexpr double degree_m = 0.015 * rad_per_deg;

/// Neither channel has max_travel_m.
const std::string without_travel =
    replaced(replaced(board_with_joint, "max_travel_m = 0.025\n", ""), "max_travel_m = 0.02\n", "");
const std::string in_deg = replaced(
    replaced(
        without_travel, "m_per_count = 1e-6\nmin_m = -0.041\nmax_m = 0.041\n",
        "deg_per_count = -0.003\noffset_deg = 2\nmin_deg = -90\nmax_deg = 100\nnoise_rms_deg = "
        "0.02\n"),
    "lever_m = 0.015\n", "lever_m = 0.015\nrange_deg = [-20.0, 30.0]\n");

std::string ranged(const std::string& range_deg, const std::string& board = without_travel) {
  return board + "range_deg = " + range_deg + "\n";
}
BoardConfig read_in_degrees(const std::string& text) {
  const auto config = parse_board_config(text, "b.toml");
  CHECK_TEXT(config.has_value(), config ? "" : to_text(config.error()).c_str());
  return config.value();
}
double travel_m(const BoardConfig& config, std::size_t channel) {
  return config.settings.channels[channel].supervision.max_travel_m;
}
void check_only_problem(const std::string& problem, const std::string& text) {
  STRCMP_EQUAL(("b.toml:" + problem + "\n").c_str(), problems_of(text).c_str());
}

}  // namespace

TEST_GROUP(JointInDegrees){};

TEST(JointInDegrees, TheAntagonistMayHaveItsOwnLever) {
  const std::string text = ranged("[-20, 30.0]") + "antagonist_lever_m = 0.010\n";
  const BoardConfig c = read_in_degrees(text);
  DOUBLES_EQUAL(30.0 * degree_m, travel_m(c, 0), 1e-12);
  DOUBLES_EQUAL(20.0 * degree_m * 2.0 / 3.0, travel_m(c, 1), 1e-12);
  const ChannelSettings& antagonist = c.settings.channels[1];
  DOUBLES_EQUAL(-1e-6 * 2.0 / 3.0, antagonist.position.scaling.per_count, 1e-18);
  DOUBLES_EQUAL(0.041 * 2.0 / 3.0, antagonist.supervision.max_position_m, 1e-12);
  DOUBLES_EQUAL(0.010, antagonist.joint.lever.zero_radius_m(), 1e-12);
  const std::string description = describe(c);
  STRCMP_CONTAINS("lever of 15 mm, the antagonist's of 10 mm\n", description.c_str());
  STRCMP_CONTAINS(
      "stiffness   16 N/m at the agonist's lever, 0.0036 Nm/rad, however much both pull: linear "
      "muscles\n",
      description.c_str());
  // This many more watts than with the agonist's lever.
  const double alike_W =
      read_in_degrees(ranged("[-20, 30.0]")).settings.joints[0].gain_ratio(c.settings.channels);
  DOUBLES_EQUAL(1.5 * alike_W, c.settings.joints[0].gain_ratio(c.settings.channels), 1e-12);
  CHECK(problems_of(ranged("[-20, 30.0]") + "antagonist_lever_m = 0\n")
            .find("joint[1].antagonist_lever_m = 0: must be 0.0001 to 1") != std::string::npos);
}

TEST(JointInDegrees, ItsRangeBoundsTheTravelOfBothMuscles) {
  const BoardConfig c = read_in_degrees(ranged("[-20, 30.0]"));
  DOUBLES_EQUAL(30.0 * degree_m, travel_m(c, 0), 1e-12);
  DOUBLES_EQUAL(20.0 * degree_m, travel_m(c, 1), 1e-12);
  // The arc of a lever that depends on the angle: from 16 mm at 0 to 14 mm at 20 degrees.
  const BoardConfig by_angle = read_in_degrees(ranged(
      "[-20, 20]", replaced(without_travel, "lever_m = 0.015\n",
                            "lever_m = [0.016, 0.016, 0.012]\nlever_range_deg = [-40, 40]\n")));
  DOUBLES_EQUAL(0.015 * 20.0 * rad_per_deg, travel_m(by_angle, 0), 1e-12);
  DOUBLES_EQUAL(0.016 * 20.0 * rad_per_deg, travel_m(by_angle, 1), 1e-12);
}

TEST(JointInDegrees, ATravelInMetresMustAgreeWithTheRange) {
  // 7.854 and 5.236 mm, rounded to two digits.
  const std::string agreeing =
      replaced(replaced(board_with_joint, "max_travel_m = 0.025", "max_travel_m = 0.0079"),
               "max_travel_m = 0.02\n", "max_travel_m = 0.0052\n");
  DOUBLES_EQUAL(30.0 * degree_m, travel_m(read_in_degrees(ranged("[-20, 30]", agreeing)), 0),
                1e-12);
  check_only_problem(
      "60: channel[2].limits.max_travel_m = 0.0052: contradicts its joint's range_deg, which gives "
      "0.00549779: leave one of them out",
      ranged("[-21, 30]", agreeing));
}

TEST(JointInDegrees, AnInvalidRangeIsTheOnlyProblemReported) {
  check_only_problem(
      "64: joint[1].range_deg = [10, 30]: must be two angles, the first below 0 and the "
      "second above it",
      ranged("[10, 30]"));
  check_only_problem(
      "64: joint[1].range_deg = [-20, 0]: must be two angles, the first below 0 and the "
      "second above it",
      ranged("[-20, 0]"));
  check_only_problem("64: joint[1].range_deg = 30: must be a list of 2 numbers, each -180 to 180",
                     ranged("30"));
  check_only_problem(
      "39: channel[1].limits.max_travel_m (its default): is 0.0445059 from its joint's range_deg, "
      "and must be within what the sensor can read: position.max_m = 0.041",
      ranged("[-20, 170]"));
}

TEST(JointInDegrees, TheRangeOfAOneMuscleJointStartsWhereItIsCold) {
  const std::string finger = small_board_with("max_travel_m = 0.025\n", "") +
                             "[[joint]]\nopposed_by = 'spring'\nagonist = 1\nlever_m = 0.015\n";
  DOUBLES_EQUAL(40.0 * degree_m, travel_m(read_in_degrees(ranged("[0, 40]", finger)), 0), 1e-12);
  for (const char* wrong : {"[-20, 40]", "[5, 40]", "[0, 0]"}) {
    check_only_problem("45: joint[1].range_deg = " + std::string(wrong) +
                           ": must be two angles, the first 0, where the one muscle is cold, and "
                           "the second above it",
                       ranged(wrong, finger));
  }
  check_only_problem(
      "41: channel[1].limits.max_travel_m = 0.025: contradicts its joint's range_deg, which gives "
      "0.010472: leave one of them out",
      ranged("[0, 40]", supercoil::test::small_board + finger.substr(finger.find("[[joint]]"))));
  STRCMP_CONTAINS("channel[1].limits.max_travel_m: is missing", problems_of(finger).c_str());
}

TEST(JointInDegrees, SensorMayBeDescribedByAngles) {
  const BoardConfig c = read_in_degrees(in_deg);
  const ChannelSettings& agonist = c.settings.channels[0];
  DOUBLES_EQUAL(-0.003 * degree_m, agonist.position.scaling.per_count, 1e-12);
  DOUBLES_EQUAL(2.0 * degree_m, agonist.position.scaling.offset, 1e-12);
  DOUBLES_EQUAL(-90.0 * degree_m, agonist.supervision.min_position_m, 1e-12);
  DOUBLES_EQUAL(100.0 * degree_m, agonist.supervision.max_position_m, 1e-12);
  DOUBLES_EQUAL(0.02 * degree_m, agonist.supervision.position_noise_rms_m, 1e-12);
  DOUBLES_EQUAL(0.003 * degree_m, c.settings.channels[1].position.scaling.per_count, 1e-12);
  // Without noise_rms_deg the noise is the default.
  const BoardConfig usual = read_in_degrees(replaced(in_deg, "noise_rms_deg = 0.02\n", ""));
  DOUBLES_EQUAL(1e-5, usual.settings.channels[0].supervision.position_noise_rms_m, 1e-15);
}

TEST(JointInDegrees, ReadingsUseAVariableLeversRadiusAtZero) {
  const BoardConfig c =
      read_in_degrees(replaced(in_deg, "lever_m = 0.015\n",
                               "lever_m = [0.014, 0.016, 0.012]\nlever_range_deg = [-40, 40]\n"));
  DOUBLES_EQUAL(100.0 * rad_per_deg * 0.016, c.settings.channels[0].supervision.max_position_m,
                1e-12);
}

TEST(JointInDegrees, SensorLimitsAreReportedInDegrees) {
  check_only_problem(
      "59: channel[2].limits.max_travel_m (its default): is 0.00523599 from its joint's "
      "range_deg, and must be within what the sensor can read: its agonist's position.min_deg = "
      "-10",
      replaced(in_deg, "min_deg = -90", "min_deg = -10"));
  STRCMP_CONTAINS("channel[1].position.min_deg = -400: must be -360 to 360",
                  problems_of(replaced(in_deg, "min_deg = -90", "min_deg = -400")).c_str());
  STRCMP_CONTAINS("channel[1].position.min_deg = 110: must be less than max_deg",
                  problems_of(replaced(in_deg, "min_deg = -90", "min_deg = 110")).c_str());
  STRCMP_CONTAINS(
      "channel[1].position.min_m = -0.01: is not a key of [channel[1].position]; its keys are: ",
      problems_of(replaced(in_deg, "min_deg = -90", "min_m = -0.01")).c_str());
}

TEST(JointInDegrees, ASingleMuscleHasNoAngle) {
  // Nothing else is reported about a joint that is wrong.
  check_only_problem("63: joint[1].agonist = 9: must be 1 to 2",
                     replaced(in_deg, "agonist = 1\n", "agonist = 9\n"));
  STRCMP_CONTAINS(
      "channel[1].position.deg_per_count = 0.01: is for the sensor of a joint's angle, and this "
      "channel is in no [[joint]]: write m_per_count",
      problems_of(small_board_with("m_per_count = 1e-6", "deg_per_count = 0.01")).c_str());
}
