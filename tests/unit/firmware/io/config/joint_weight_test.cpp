// Boards with a joint that one muscle turns against the weight of an arm.
#include <numbers>
#include <string>

#include <CppUTest/TestHarness.h>

#include "config/describe.hpp"
#include "unit/firmware/io/config/support/small_board.hpp"

using namespace supercoil;
using namespace supercoil::config;
using supercoil::test::problems_of;
using supercoil::test::replaced;
using supercoil::test::small_board_with;

namespace {

constexpr double rad_per_deg = std::numbers::pi / 180.0;

/// Muscle and weight together: 16 N/m from the muscle, 15.7 from the weight.
const std::string arm =
    small_board_with("max_travel_m = 0.025\n", "[channel.muscle]\nstiffness_N_per_m = 31.7\n") +
    "[[joint]]\nopposed_by = 'gravity'\nagonist = 1\nlever_m = 0.015\nweight_Nm = 0.005\n"
    "hangs_at_deg = -45\nrange_deg = [0, 60]\n";

BoardConfig read_arm(const std::string& text) {
  const auto config = parse_board_config(text, "b.toml");
  CHECK_TEXT(config.has_value(), config ? "" : to_text(config.error()).c_str());
  return config.value();
}
void check_only_arm_problem(const std::string& problem, const std::string& text) {
  STRCMP_EQUAL(("b.toml:" + problem + "\n").c_str(), problems_of(text).c_str());
}

}  // namespace

TEST_GROUP(JointWithAWeight){};

TEST(JointWithAWeight, HasTheArmsWeightAndHangingAngle) {
  const ChannelSettings channel = read_arm(arm).settings.channels[0];
  CHECK(channel.joint.turns() && channel.joint.weighs() && !channel.joint.has_other());
  DOUBLES_EQUAL(0.005, channel.joint.weight_Nm, 0.0);
  DOUBLES_EQUAL(-45.0 * rad_per_deg, channel.joint.hangs_at_rad, 1e-12);
  DOUBLES_EQUAL(60.0 * rad_per_deg * 0.015, channel.supervision.max_travel_m, 1e-12);
  CHECK(channel.supervision.proof_of_response);
  check_only_arm_problem("43: joint[1].weight_Nm: is missing: it must be a number, 1e-06 to 100",
                         replaced(arm, "weight_Nm = 0.005\n", ""));
  check_only_arm_problem("48: joint[1].hangs_at_deg = 10: must be -179 to 0",
                         replaced(arm, "-45", "10"));
  check_only_arm_problem(
      "47: joint[1].weight_Nm = 0.005: is not a key of [joint[1]]; its keys are: "
      "opposed_by, agonist, lever_range_deg, lever_m, range_deg, name",
      replaced(replaced(arm, "gravity", "spring"), "hangs_at_deg = -45\n", ""));
}

TEST(JointWithAWeight, CheckReportsThePowerToHoldAngles) {
  const std::string text = describe(read_arm(arm));
  STRCMP_CONTAINS(
      "  joint       turned against gravity; lever of 15 mm; held indefinitely up to 9.7 mm (37°); "
      "0.0071325 Nm/rad at 0°\n"
      "              the weight pulls the cold muscle with 0.236 N; held at 15° with 1.2 W, 30° "
      "with 2.19 W, 45° with 2.96 W, 60° with "
      "3.49 W; pulls with up to 0.333 N\n",
      text.c_str());
}

TEST(JointWithAWeight, MustPullTheArmBackFromEveryAngle) {
  check_only_arm_problem(
      "48: joint[1].hangs_at_deg = -130: lets the arm stand upright at 50°, from where nothing "
      "pulls it back, and its travel goes up to 60°",
      replaced(arm, "-45", "-130"));
}

TEST(JointWithAWeight, MustNotExceedTheMusclesStiffness) {
  check_only_arm_problem(
      "47: joint[1].weight_Nm = 0.0101: alone makes the joint 31.7412 N/m stiff at 0°, and "
      "channel[1].muscle.stiffness_N_per_m = 31.7 is that of muscle and weight together: raise it, "
      "or reduce the weight to less than 0.0100869",
      replaced(arm, "weight_Nm = 0.005", "weight_Nm = 0.0101"));
}

TEST(JointWithAWeight, AdvisesToEndTheTravelWhereTheArmTipsOver) {
  const auto advised = [](const std::string& text) {
    std::string all;
    for (const std::string& line : advice(read_arm(text)))
      all += line + "\n";
    return all.find("the arm tips over") != std::string::npos
               ? all.substr(all.find("above"), all.find(" the arm") - all.find("above"))
               : "";
  };
  STRCMP_EQUAL("", advised(arm).c_str());
  // The muscle itself has 4 N/m; the weight cancels that when the arm is 10° above level.
  STRCMP_EQUAL("above 55.3°", advised(replaced(arm, "31.7", "19.7")).c_str());
}
