// Boards with a joint: two channels that pull one lever against each other.
#include <algorithm>
#include <string>

#include <CppUTest/TestHarness.h>

#include "config/bus_time.hpp"
#include "config/describe.hpp"
#include "unit/firmware/io/config/support/checked_board.hpp"
#include "unit/firmware/io/config/support/joint_board.hpp"

using namespace supercoil;
using namespace supercoil::config;
using supercoil::test::board_with_joint;
using supercoil::test::check_answer;
using supercoil::test::one_joint;
using supercoil::test::problems_of;
using supercoil::test::read_board;
using supercoil::test::replaced;
using supercoil::test::second_channel;
using supercoil::test::small_board;

namespace {

/// The position is not moved: it stays with the first channel.
const std::string swapped = replaced(replaced(board_with_joint, "agonist = 1\n", "agonist = 2\n"),
                                     "antagonist = 2", "antagonist = 1");

}  // namespace

TEST_GROUP(JointConfig){};

TEST(JointConfig, AntagonistHasTheAgonistsPositionNegated) {
  const BoardConfig c = read_board(board_with_joint);
  UNSIGNED_LONGS_EQUAL(1, c.settings.joints.size());
  const JointSettings& joint = c.settings.joints[0];
  UNSIGNED_LONGS_EQUAL(0, joint.agonist);
  UNSIGNED_LONGS_EQUAL(1, joint.antagonist);
  DOUBLES_EQUAL(0.015, joint.lever.zero_radius_m(), 0.0);
  STRCMP_EQUAL("elbow", c.joints[0].name.c_str());
  const ChannelSettings& antagonist = c.settings.channels[1];
  DOUBLES_EQUAL(-1e-6, antagonist.position.scaling.per_count, 0.0);
  DOUBLES_EQUAL(-0.041, antagonist.supervision.min_position_m, 0.0);
  DOUBLES_EQUAL(0.041, antagonist.supervision.max_position_m, 0.0);
  STRCMP_EQUAL("voltage1", c.wiring.channels[1].position.input.c_str());
  CHECK(c.wiring.channels[1].position_of == std::size_t{0});
  // The proof is for a single muscle: --check and the rows say that it is off.
  for (const ChannelSettings& channel : c.settings.channels)
    CHECK_FALSE(channel.supervision.proof_of_response);
}

/// 135 bits, 50 times a second, at 500 kbit/s.
TEST(JointConfig, TheJointIsPartOfTheLoadOfTheCanBus) {
  const auto described = [](const std::string& text) {
    return describe(read_board(text + "[can]\n"));
  };
  const std::string with_joint = described(board_with_joint);
  STRCMP_CONTAINS("load    19.1 % at worst", with_joint.c_str());
  STRCMP_CONTAINS("\n  joint 50 Hz, of each joint\n", with_joint.c_str());
  const std::string alone = described(small_board);
  CHECK(alone.find("joint") == std::string::npos);
  check_answer("can.rates.joint_Hz = 2000: must be 0 to 1000",
               board_with_joint + "[can]\nrates = {joint_Hz = 2000}\n");
}

TEST(JointConfig, ASpringMayBeInTheAntagonistsPlace) {
  const std::string spring =
      "[[joint]]\nname = 'finger'\nopposed_by = 'spring'\nagonist = 1\nlever_m = 0.015\n";
  const BoardConfig c = read_board(small_board + spring);
  UNSIGNED_LONGS_EQUAL(0, c.settings.joints.size());
  const ChannelSettings& channel = c.settings.channels[0];
  CHECK(channel.joint.turns() && !channel.joint.has_other());
  DOUBLES_EQUAL(0.015, channel.joint.lever.zero_radius_m(), 0.0);
  // Only its muscle moves the joint, so the muscle can prove that it responds.
  CHECK(channel.supervision.proof_of_response);
  STRCMP_CONTAINS(
      "  joint       finger, turned against a spring; lever of 15 mm; held indefinitely up to",
      describe(c).c_str());
  check_answer("joint[1].antagonist = 2: is not a key of",
               small_board + spring + "antagonist = 2\n");
  check_answer("is not a key of [joint[1]]", small_board + spring + "co_contraction_W = 0.5\n");
  check_answer("joint[1].opposed_by = 'rope': must be one of: muscle, spring, gravity",
               small_board + replaced(spring, "spring'", "rope'"));
  // With an unknown kind, nothing is said about a missing antagonist.
  CHECK(problems_of(small_board + replaced(spring, "spring'", "rope'")).find("antagonist") ==
        std::string::npos);
  check_answer("joint[1].agonist = 2: must be 1",
               small_board + replaced(spring, "agonist = 1", "agonist = 2"));
}

TEST(JointConfig, TheAgonistMayComeAfterItsAntagonist) {
  const std::string position =
      "[channel.position]\ndevice = \"adc\"\ninput = \"voltage1\"\nm_per_count = 1e-6\n"
      "min_m = -0.041\nmax_m = 0.03\n";
  const std::string without =
      replaced(replaced(swapped, "max_m = 0.041", "max_m = 0.03"), position, "");
  const std::string current = "[channel.current]\ndevice = \"adc\"\ninput = \"voltage3\"";
  const BoardConfig c = read_board(replaced(without, current, position + current));
  const JointSettings& joint = c.settings.joints[0];
  UNSIGNED_LONGS_EQUAL(1, joint.agonist);
  UNSIGNED_LONGS_EQUAL(0, joint.antagonist);
  // The channels keep their places although the first one is read last.
  DOUBLES_EQUAL(4.5, c.settings.channels[0].limiter.max_W, 0.0);
  DOUBLES_EQUAL(4.0, c.settings.channels[1].limiter.max_W, 0.0);
  STRCMP_EQUAL("voltage2", c.wiring.channels[0].current.input.c_str());
  DOUBLES_EQUAL(-0.03, c.settings.channels[0].supervision.min_position_m, 0.0);
  DOUBLES_EQUAL(-0.041, c.settings.channels[1].supervision.min_position_m, 0.0);
  CHECK(c.wiring.channels[0].position_of == std::size_t{1});
  CHECK_FALSE(c.wiring.channels[1].position_of.has_value());
  LONGS_EQUAL(-1, c.settings.channels[0].joint.direction);
  DOUBLES_EQUAL(1.0, c.settings.channels[0].joint.other_channel_offset, 0.0);
  STRCMP_CONTAINS("agonist channel 2, antagonist channel 1", describe(c).c_str());
}

TEST(JointConfig, CoContractionDefaultsToAFifthOfTheWeakerMuscle) {
  // 4 W of the antagonist, each of which moves the joint as far as 0.089/0.0712 W of the agonist,
  // are more than the agonist's 4.5 W.
  DOUBLES_EQUAL(0.2 * 4.5, read_board(board_with_joint).settings.joints[0].co_contraction_W, 1e-12);
  DOUBLES_EQUAL(
      1.5,
      read_board(board_with_joint + "co_contraction_W = 1.5\n").settings.joints[0].co_contraction_W,
      0.0);
}

TEST(JointConfig, CoContractionHasALimit) {
  const auto limit_W = [](const std::string& more) {
    return read_board(board_with_joint + more).settings.joints[0].max_co_contraction_W;
  };
  DOUBLES_EQUAL(0.5 * 4.5, limit_W(""), 1e-12);
  DOUBLES_EQUAL(3.0, limit_W("max_co_contraction_W = 3.0\n"), 0.0);
  STRCMP_EQUAL(
      "b.toml:66: joint[1].co_contraction_W = 2.3: must not exceed max_co_contraction_W, which is "
      "2.25\n",
      problems_of(board_with_joint + "co_contraction_W = 2.3\n").c_str());
  check_answer(
      "joint[1].co_contraction_W = 0.9: must not exceed max_co_contraction_W, which is 0.8",
      board_with_joint + "co_contraction_W = 0.9\nmax_co_contraction_W = 0.8\n");
  check_answer("joint[1].max_co_contraction_W = 4.6: must be 0 to 4.5",
               board_with_joint + "max_co_contraction_W = 4.6\n");
  // The default co-contraction does not exceed the maximum.
  const BoardConfig low = read_board(board_with_joint + "max_co_contraction_W = 0.5\n");
  DOUBLES_EQUAL(0.5, low.settings.joints[0].co_contraction_W, 0.0);
}

TEST(JointConfig, APairThatCanTearItselfIsRefused) {
  // For the agonist 0.0086 N/K at 2.25 W / 0.045 W/K, for the antagonist at 1.8 W.
  STRCMP_EQUAL(
      "b.toml:66: joint[1].max_pull_N = 0.5: is less than channel 1 may pull with: a pretension of "
      "0.1 N, and 0.43 N from the heat of max_co_contraction_W = 2.25, which is 2.25 W there; "
      "max_co_contraction_W must be 0 to 2.093, or max_pull_N at least 0.53\n",
      problems_of(board_with_joint + "max_pull_N = 0.5\npretension_N = 0.1\n").c_str());
  for (const char* in_order :
       {"max_pull_N = 0.53\npretension_N = 0.1\n", "max_pull_N = 0.43\n",
        "max_pull_N = 0.5\npretension_N = 0.1\nmax_co_contraction_W = 2.093\n"})
    STRCMP_EQUAL("", problems_of(board_with_joint + in_order).c_str());
  check_answer("joint[1].max_pull_N = 0.3: must not be less than the pretension, which is 0.4 N",
               board_with_joint + "max_pull_N = 0.3\npretension_N = 0.4\n");
  check_answer("joint[1].max_pull_N = 0: must be 0.001 to 10000",
               board_with_joint + "max_pull_N = 0\n");
  check_answer("joint[1].pretension_N = -1: must be 0 to 10000",
               board_with_joint + "pretension_N = -1\n");
}

TEST(JointConfig, TheMuscleThatPullsHarderIsNamed) {
  const std::string badly_cooled =
      replaced(board_with_joint,
               "max_mass_J_per_K = 0.20\nmin_transfer_W_per_K = 0.045\nmax_transfer_W_per_K = "
               "0.18\n[channel.limits]\nmax_W = 4.0",
               "max_mass_J_per_K = 0.20\nmin_transfer_W_per_K = 0.030\nmax_transfer_W_per_K = "
               "0.18\n[channel.limits]\nmax_W = 4.0");
  check_answer(
      "joint[1].max_pull_N = 0.45: is less than channel 2 may pull with: a pretension of 0 N, and "
      "0.516 N from the heat of max_co_contraction_W = 2.25, which is 1.8 W there; "
      "max_co_contraction_W must be 0 to 1.962, or max_pull_N at least 0.516",
      badly_cooled + "max_pull_N = 0.45\n");
  // Not hotter than it may become: (50 - 15) K.
  const std::string cool =
      replaced(badly_cooled, "[channel.limits]\nmax_W = 4.0",
               "[channel.limits]\ntrip_C = 50\nderate_from_C = 40\nmax_W = 4.0");
  STRCMP_EQUAL("", problems_of(cool + "max_pull_N = 0.45\n").c_str());
}

TEST(JointConfig, CheckReportsTheForcesOfThePair) {
  const std::string text =
      describe(read_board(board_with_joint + "max_pull_N = 0.8\npretension_N = 0.1\n"));
  for (const char* part :
       {"the heat of this measured power adds at most 0.43 N and 0.35 N to the pretension of 0.1 "
        "N: within max_pull_N = 0.8",
        "joint 1: if something blocks it, channel 1 alone may pull with up to 0.96 N at its "
        "max_W = 4.5, more than max_pull_N = 0.8",
        "channel 2 alone may pull with up to 0.87 N"})
    STRCMP_CONTAINS(part, text.c_str());
}

TEST(JointConfig, ASharedConverterIsReadOnce) {
  const std::string on_bus = replaced(board_with_joint, "device = \"adc\"\ninput = \"voltage1\"",
                                      "device = \"adc\"\nbus = \"i2c-1\"\ninput = \"voltage1\"");
  const BoardConfig c = read_board(on_bus);
  UNSIGNED_LONGS_EQUAL(1, bus_time(c.wiring, c.wiring.buses[0]).users.size());
}

TEST(JointConfig, CheckReportsWhatTheJointCanDo) {
  const std::string text = describe(read_board(board_with_joint));
  for (const char* part :
       {"joint 1: elbow", "agonist channel 1, antagonist channel 2", "lever of 15 mm",
        "with 0.9 W and 0.7 W while no effort is asked for; each muscle contributes half of an "
        "effort",
        "at most with 2.2 W and 1.8 W",
        // By 2.25 W, and 1.8 W for the antagonist, at 0.045 W/K: hotter than is believed.
        "the heat of this measured power adds at most 0.43 N and 0.35 N to the pretension; "
        "max_pull_N, "
        "the max pull they bear, is not configured",
        "stiffness   16 N/m at the lever, 0.0036 Nm/rad, however much both pull: linear muscles\n"})
    STRCMP_CONTAINS(part, text.c_str());
}

/// Each muscle's figures are for the muscle alone; the air moves both.
TEST(JointConfig, CheckReportsNoRestOfOneMuscleInTheAir) {
  const std::string text = describe(read_board(board_with_joint));
  CHECK(text.find("lower in the coldest air") == std::string::npos);
  CHECK(text.find("down from there") == std::string::npos);
  CHECK(text.find("below its zero") == std::string::npos);
  STRCMP_CONTAINS("; all by itself: the joint's other muscle pulls it back\n", text.c_str());
  STRCMP_CONTAINS("  rests       at ", text.c_str());
  STRCMP_CONTAINS(" in the coldest air, if its zero was taken in the warmest\n", text.c_str());
}

TEST(JointConfig, CheckReportsWhereAMuscleGoesSlack) {
  STRCMP_CONTAINS("  slack       unknown: pretension_N is not configured\n",
                  describe(read_board(board_with_joint)).c_str());
  const BoardConfig alike = read_board(board_with_joint + "pretension_N = 0.02\n");
  const JointSettings& joint = alike.settings.joints[0];
  DOUBLES_EQUAL(0.02, joint.pretension_N, 0.0);
  for (const std::size_t channel : {joint.agonist, joint.antagonist}) {
    const PlaceInJoint& place = alike.settings.channels[channel].joint;
    DOUBLES_EQUAL(0.02, place.pretension_N, 0.0);
    DOUBLES_EQUAL(0.5, place.stiffness_ratio, 0.0);
  }
  // 0.02 N over 8 N/m is 2.5 mm.
  STRCMP_CONTAINS("  slack       by the model, without power: the agonist from 9.5° on, taut at ",
                  describe(alike).c_str());
  STRCMP_CONTAINS("; the antagonist from -9.5° on, taut at ", describe(alike).c_str());
  const BoardConfig config =
      read_board(board_with_joint + "pretension_N = 0.02\nstiffness_ratio = [0.25, 0.0]\n");
  STRCMP_CONTAINS("the agonist from 19.1° on", describe(config).c_str());
  STRCMP_CONTAINS("the antagonist nowhere within its travel\n", describe(config).c_str());
  check_answer(
      "joint[1].stiffness_ratio = [0.5, 0.6]: must not exceed 1 in total: a spring has the rest",
      board_with_joint + "stiffness_ratio = [0.5, 0.6]\n");
  check_answer("joint[1].stiffness_ratio", board_with_joint + "stiffness_ratio = [0.5]\n");
}

TEST(JointConfig, TheAgonistsSensorLimitsTheAntagonistsTravel) {
  STRCMP_EQUAL(
      "b.toml:60: channel[2].limits.max_travel_m = 0.02: must be within what the sensor can read: "
      "its agonist's position.min_m = 0\n",
      problems_of(replaced(board_with_joint, "min_m = -0.041", "min_m = 0.0")).c_str());
}

TEST(JointConfig, AnErrorInAJointCausesNoFurtherErrors) {
  const auto check_only = [](const std::string& problem, const std::string& text) {
    STRCMP_EQUAL(("b.toml:" + problem + "\n").c_str(), problems_of(text).c_str());
  };
  check_only("65: joint[1].lever_m = 15: must be 0.0001 to 1",
             replaced(board_with_joint, "lever_m = 0.015", "lever_m = 15"));
  check_only("61: joint[1].lever_m: is missing: it must be a number, 0.0001 to 1",
             replaced(board_with_joint, "lever_m = 0.015\n", ""));
  check_only("63: joint[1].agonist = [1, 3]: must be a whole number, 1 to 2",
             replaced(board_with_joint, "agonist = 1\n", "agonist = [1, 3]\n"));
  check_only("63: joint[1].agonist = 9: must be 1 to 2",
             replaced(board_with_joint, "agonist = 1\n", "agonist = 9\n"));
  check_only("64: joint[1].antagonist = 1: is a channel that is already in a joint",
             replaced(board_with_joint, "antagonist = 2", "antagonist = 1"));
}

TEST(JointConfig, ProofOfResponseIsNotAvailableInAJoint) {
  const std::string proof = board_with_joint + "[every_channel.detectors]\nproof_of_response = ";
  check_answer(
      "every_channel.detectors.proof_of_response = true: is not available in a joint: the other "
      "muscle moves it as well; leave it out, or set it to false",
      proof + "true\n");
  STRCMP_EQUAL("", problems_of(proof + "false\n").c_str());
  const std::string text = describe(read_board(board_with_joint));
  STRCMP_CONTAINS("of a few um: not checked: the joint's other muscle moves it as well",
                  text.c_str());
  STRCMP_CONTAINS("heater_not_responding: proof of response is not available in a joint",
                  text.c_str());
  CHECK(text.find("proof_of_response is false") == std::string::npos);
}

TEST(JointConfig, MusclesShouldAgreeOnTheJointsParameters) {
  const auto described = [](const std::string& lines) {
    return describe(read_board(replaced(board_with_joint, "heat_transfer_W_per_K = 0.0712\n",
                                        "heat_transfer_W_per_K = 0.0712\n" + lines)));
  };
  STRCMP_CONTAINS(
      "joint 1: muscle.stiffness_N_per_m is 16 of channel 1 and 22 of channel 2: each describes "
      "the whole joint, and they should be the same",
      described("stiffness_N_per_m = 22\n").c_str());
  STRCMP_CONTAINS("muscle.damping_Ns_per_m is 2 of channel 1 and 1 of channel 2",
                  described("damping_Ns_per_m = 1\n").c_str());
  STRCMP_CONTAINS("muscle.moving_mass_kg is 0.09 of channel 1 and 0.2 of channel 2",
                  described("moving_mass_kg = 0.2\n").c_str());
  const std::string alike = described(
      "stiffness_N_per_m = 20\ndamping_Ns_per_m = 1.6\nforce_per_kelvin_N_per_K = 0.02\n");
  CHECK(alike.find("describes the whole joint") == std::string::npos);
}

TEST(JointConfig, AnAntagonistHasNoControllerOfItsOwn) {
  const BoardConfig c = read_board(board_with_joint);
  STRCMP_CONTAINS("controllers led by channel 1: its own are not used",
                  describe_channel(c, 1).c_str());
  CHECK(describe_channel(c, 1).find("can follow") == std::string::npos);
  STRCMP_CONTAINS("controller 0 can follow", describe_channel(c, 0).c_str());
  CHECK(advice(c.settings.channels[1], c.settings).empty());
}

TEST(JointConfig, ImpossibleKeysAreNamed) {
  check_answer(
      "channel[2].position: is taken from its agonist, channel 1, with the opposite sign",
      replaced(board_with_joint, "[channel.current]\ndevice = \"adc\"\ninput = \"voltage3\"",
               "position = {device = \"adc\", input = \"voltage9\"}\n"
               "[channel.current]\ndevice = \"adc\"\ninput = \"voltage3\""));
  check_answer(
      "channel[1].position: is taken from its agonist, channel 2, with the opposite sign: leave "
      "it out, or move it there",
      swapped);
  check_answer("joint[1].antagonist = 1: is a channel that is already in a joint",
               replaced(board_with_joint, "antagonist = 2", "antagonist = 1"));
  check_answer("joint[1].antagonist = 3: must be 1 to 2",
               replaced(board_with_joint, "antagonist = 2", "antagonist = 3"));
  CHECK(
      problems_of(replaced(board_with_joint, "antagonist = 2", "antagonist = 3")).find("already") ==
      std::string::npos);
  check_answer("joint[2].agonist = 1: is a channel that is already in a joint",
               board_with_joint + one_joint);
  check_answer("joint[1].lever_m: is missing", replaced(board_with_joint, "lever_m = 0.015\n", ""));
  check_answer("is not a key of [joint[1]]; did you mean antagonist?",
               replaced(board_with_joint, "antagonist", "antagonst"));
  check_answer(
      "joint[1].speed = 3: is not a key of [joint[1]]; its keys are: opposed_by, agonist, "
      "antagonist, "
      "lever_range_deg, lever_m, antagonist_lever_m, range_deg, name, co_contraction_W, "
      "max_co_contraction_W, "
      "max_pull_N, "
      "pretension_N, stiffness_ratio\n",
      board_with_joint + "speed = 3\n");
  check_answer(
      "is already channel 1's position: input voltage1 of adc; two muscles that turn one "
      "joint need a [[joint]]",
      replaced(small_board + second_channel,
               "[channel.current]\ndevice = \"adc\"\ninput = \"voltage3\"",
               "position = {device = \"adc\", input = \"voltage1\", m_per_count = 1e-6, "
               "min_m = 0, max_m = 1}\n"
               "[channel.current]\ndevice = \"adc\"\ninput = \"voltage3\""));
}
