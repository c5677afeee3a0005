// Boards with a [[bundle]]: channels that pull together, each with its own heater.
#include <string>

#include <CppUTest/TestHarness.h>

#include "config/describe.hpp"
#include "unit/firmware/io/config/support/joint_board.hpp"

using namespace supercoil;
using namespace supercoil::config;
using supercoil::test::problems_of;
using supercoil::test::replaced;
using supercoil::test::second_channel;
using supercoil::test::small_board;

namespace {

const std::string one_bundle = "[[bundle]]\nname = 'lifter'\nchannels = [1, 2]\n";
const std::string second_of_bundle =
    replaced(second_channel, "max_travel_m = 0.02", "max_travel_m = 0.025");
const std::string board_with_bundle = small_board + second_of_bundle + one_bundle;

BoardConfig read_bundle_board(const std::string& text) {
  const auto config = parse_board_config(text, "b.toml");
  CHECK_TEXT(config.has_value(), config ? "" : to_text(config.error()).c_str());
  return config.value();
}

void check_refused(const std::string& part, const std::string& text) {
  STRCMP_CONTAINS(part.c_str(), problems_of(text).c_str());
}

std::string with_channels(const std::string& list) {
  return replaced(board_with_bundle, "channels = [1, 2]", "channels = " + list);
}

}  // namespace

TEST_GROUP(BundleConfig){};

TEST(BundleConfig, FollowersUseTheLeadersPosition) {
  const BoardConfig c = read_bundle_board(board_with_bundle);
  UNSIGNED_LONGS_EQUAL(1, c.settings.bundles.size());
  UNSIGNED_LONGS_EQUAL(0, c.settings.bundles[0].leader());
  STRCMP_EQUAL("lifter", c.bundles[0].c_str());
  const ChannelSettings& leader = c.settings.channels[0];
  const ChannelSettings& follower = c.settings.channels[1];
  DOUBLES_EQUAL(leader.position.scaling.per_count, follower.position.scaling.per_count, 0.0);
  DOUBLES_EQUAL(leader.supervision.min_position_m, follower.supervision.min_position_m, 0.0);
  DOUBLES_EQUAL(leader.supervision.max_position_m, follower.supervision.max_position_m, 0.0);
  CHECK(c.wiring.channels[1].position_of == std::size_t{0});
  CHECK(leader.bundle.bundled && !leader.bundle.follows());
  DOUBLES_EQUAL(-1.0, follower.bundle.leader_offset, 0.0);
}

TEST(BundleConfig, TheProofOfResponseIsTheLeaders) {
  // Even if the file asks for it on every channel.
  for (const char* every : {"", "[every_channel.detectors]\nproof_of_response = true\n"}) {
    const BoardConfig c = read_bundle_board(every + board_with_bundle);
    CHECK(c.settings.channels[0].supervision.proof_of_response);
    CHECK_FALSE(c.settings.channels[1].supervision.proof_of_response);
  }
}

TEST(BundleConfig, CheckNamesTheLeaderAndThePower) {
  const std::string text = describe(read_bundle_board(board_with_bundle));
  STRCMP_CONTAINS(
      "bundle 1: lifter\n  muscles     channels 1 and 2 pull together; commands go to channel 1\n"
      "  power       the same for each, at most 4 W: 8 W together\n",
      text.c_str());
  STRCMP_CONTAINS("controllers led by channel 1: its own are not used", text.c_str());
  STRCMP_CONTAINS("checked for the bundle as a whole, by the channel that leads it", text.c_str());
  STRCMP_CONTAINS("only the bundle as a whole proves its response", text.c_str());
}

TEST(BundleConfig, TheLeaderMayBeALaterChannel) {
  const std::string position = "[channel.position]\ndevice = \"adc\"\ninput = \"voltage1\"\n";
  CHECK(small_board.find("voltage1") != std::string::npos);
  const std::string problems = problems_of(with_channels("[2, 1]"));
  // In this file the first channel has the sensor: the problem is reported there.
  STRCMP_CONTAINS("position: is taken from its bundle, channel 2: leave it out, or move it there",
                  problems.c_str());
}

TEST(BundleConfig, ErrorsNameTheProblem) {
  check_refused("bundle[1].channels: is missing: it must be a list of 2 numbers, each 1 to 2",
                replaced(board_with_bundle, "channels = [1, 2]\n", ""));
  check_refused("bundle[1].channels = [1]: must be a list of 2 numbers, each 1 to 2",
                with_channels("[1]"));
  check_refused("bundle[1].channels = [1, 3]: must be a list of 2 numbers, each 1 to 2; 3 is not",
                with_channels("[1, 3]"));
  check_refused(
      "bundle[1].channels = [1, 1.5]: channel 1.5 does not exist: channels are numbered from 1",
      with_channels("[1, 1.5]"));
  check_refused("bundle[1].channels = [1, 1]: channel 1 is already in a bundle",
                with_channels("[1, 1]"));
  check_refused("bundle[2].channels = [1, 2]: channel 1 is already in a bundle",
                board_with_bundle + one_bundle);
  check_refused("bundle[1].wired = 'series': is not a key of [bundle[1]]",
                board_with_bundle + "wired = 'series'\n");
  check_refused(
      "bundle[1].channels = [1, 2]: channel 1 turns a joint, and so cannot be in a bundle",
      supercoil::test::board_with_joint + one_bundle);
}

TEST(BundleConfig, ABoardThatLacksItsChannelsIsRefused) {
  check_refused("bundle[1].channels = [1, 2]: channel 2 is not in this file",
                small_board + one_bundle);
}

TEST(BundleConfig, FollowersMayNotBeStricterThanTheLeader) {
  const auto refused = [](const std::string& what, const std::string& old,
                          const std::string& replacement) {
    check_refused("channel 2's " + what + " that of channel 1, which leads",
                  small_board + replaced(second_of_bundle, old, replacement) + one_bundle);
  };
  refused("limits.max_travel_m is less than", "max_travel_m = 0.025", "max_travel_m = 0.02");
  refused("limits.trip_C is less than", "max_W = 4.0", "max_W = 4.0\ntrip_C = 150");
  refused("limits.derate_from_C is less than", "max_W = 4.0", "max_W = 4.0\nderate_from_C = 100");
  refused("thermal.min_mass_J_per_K is less than", "min_mass_J_per_K = 0.13",
          "min_mass_J_per_K = 0.12");
  refused("thermal.min_transfer_W_per_K is less than", "min_transfer_W_per_K = 0.045",
          "min_transfer_W_per_K = 0.04");
  refused("limits.min_W is more than", "max_W = 4.0", "max_W = 4.0\nmin_W = 0.1");
  refused("limits.slew_W_per_s is less than", "max_W = 4.0", "max_W = 4.0\nslew_W_per_s = 2.0");
}

TEST(BundleConfig, ReportsOnlyTheWrongKey) {
  const std::string problems = problems_of(with_channels("[1, 1]"));
  CHECK(problems.find("position") == std::string::npos);
}

TEST(BundleConfig, SharingASensorSuggestsABundle) {
  check_refused(
      "those that pull together a [[bundle]]",
      small_board + second_of_bundle +
          "[channel.position]\ndevice = \"adc\"\ninput = \"voltage1\"\nm_per_count = 1e-6\n"
          "min_m = -0.001\nmax_m = 0.041\n");
}
