#include "text/command_text.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>

using namespace supercoil;

namespace {
constexpr std::size_t channels = 4;
}

TEST_GROUP(CommandText){
    static Command read(std::string_view text){const auto command = parse_command(text, channels);
if (!command) FAIL(command.error().text().c_str());
return *command;
}
static void check_wrong(std::string_view text, const char* why) {
  const auto command = parse_command(text, channels);
  CHECK_FALSE(command.has_value());
  STRCMP_EQUAL(why, command.error().text().c_str());
}
}
;

TEST(CommandText, HasChannelVerbAndValue) {
  const Command follow = read(" 2  position 0.0125\n");
  LONGS_EQUAL(1, follow.channel);
  CHECK(follow.verb == Verb::position);
  DOUBLES_EQUAL(0.0125, follow.value, 0.0);
  CHECK(read("1 arm").verb == Verb::arm);
  CHECK(read("4 power 1e0").verb == Verb::power);
  CHECK(read("1 compare_supply 12.03").verb == Verb::compare_supply);
  DOUBLES_EQUAL(0.217, read("1 compare_current 0.217").value, 0.0);
  DOUBLES_EQUAL(61.5, read("1 compare_rise 61.5").value, 0.0);
  CHECK(read("1 store").verb == Verb::store);
  DOUBLES_EQUAL(1.0, read("1 store").value, 0.0);
  DOUBLES_EQUAL(store_tuning, read("1 store tuning").value, 0.0);
  DOUBLES_EQUAL(clear_tuning, read("1 clear tuning").value, 0.0);
  DOUBLES_EQUAL(2.0, read("1 tune 2").value, 0.0);
  CHECK(read("1 clear").verb == Verb::store);
  DOUBLES_EQUAL(0.0, read("1 clear").value, 0.0);
}

TEST(CommandText, ErrorsNameTheProblem) {
  check_wrong("", "channel '': must be 1 to 4");
  check_wrong("0 arm", "channel '0': must be 1 to 4");
  check_wrong("5 arm", "channel '5': must be 1 to 4");
  check_wrong("-1 arm", "channel '-1': must be 1 to 4");
  check_wrong("99999999999999999999 arm", "channel '99999999999999999999': must be 1 to 4");
  check_wrong("1 position", "position needs a number, in m");
  check_wrong("1 position 5mm", "position needs a number, in m; '5mm' is not one");
  check_wrong("1 position nan", "position needs a number, in m; 'nan' is not one");
  check_wrong("1 power inf", "power needs a number, in W; 'inf' is not one");
  check_wrong("arm 1", "channel 'arm': must be 1 to 4; it comes first, as in '1 arm'");
  check_wrong("1",
              "no command after the channel; there are: arm, disarm, reset, position, power, "
              "renew, rest, identify, calibrate, scale, controller, estimator, store, "
              "compare_supply, compare_current, compare_rise, tune, clear, store tuning, clear "
              "tuning");
  check_wrong("1 amr", "'amr' is not a command; did you mean arm?");
  check_wrong("1 calibrat", "'calibrat' is not a command; did you mean calibrate?");
  check_wrong("1 power", "power needs a number, in W");
  check_wrong("1 tune pi",
              "tune needs a whole number, its place in the configuration from 0; 'pi' is not one");
  check_wrong(
      "1 controller 1.5",
      "controller needs a whole number, its place in the configuration from 0; '1.5' is not one");
  check_wrong("1 power -0.001", "power must be 0 W or more");
  check_wrong("1 position 0.01 5", "position takes one value: leave out '5'");
  check_wrong("1 arm now", "arm takes no value: leave out 'now'");
  check_wrong("1 heat",
              "'heat' is not a command; there are: arm, disarm, reset, position, power, renew, "
              "rest, identify, calibrate, scale, controller, estimator, store, compare_supply, "
              "compare_current, compare_rise, tune, clear, store tuning, clear tuning");
  check_wrong("1 store 1", "store takes no value: leave out '1'");
  check_wrong("1 clear 5", "clear takes no value: leave out '5'");
}

TEST(CommandText, ErrorsOnABusSpeakOfNodes) {
  for (const auto& [text, why] : {std::pair{"0 arm", "node '0': must be 1 to 63"},
                                  std::pair{"1", "no command after the node; there are: arm"}})
    STRCMP_CONTAINS(why, parse_command(text, 63, "node").error().text().c_str());
}

TEST(CommandText, KnotsAndStartsOfATrajectoryAreOnlyForTheSocket) {
  const auto knot = parse_trajectory_command("2 knot 0.02 0.0051 -0.001", channels);
  CHECK(knot && *knot);
  CHECK((*knot)->verb == Verb::knot);
  LONGS_EQUAL(1, (*knot)->channel);
  DOUBLES_EQUAL(0.02, (*knot)->after_s, 1e-9);
  DOUBLES_EQUAL(0.0051, (*knot)->value, 0.0);
  DOUBLES_EQUAL(-0.001, (*knot)->velocity_m_per_s, 1e-9);
  const auto start = parse_trajectory_command("1 start 86400.123456789", channels);
  CHECK(start && *start);
  CHECK((*start)->verb == Verb::start);
  DOUBLES_EQUAL(86400.123456789, (*start)->value, 0.0);
  CHECK_FALSE(parse_trajectory_command("1 position 0.001", channels).has_value());
  CHECK_FALSE(parse_trajectory_command("", channels).has_value());
  check_wrong("1 start 5",
              "'start' is not a command; there are: arm, disarm, reset, position, power, renew, "
              "rest, identify, calibrate, scale, controller, estimator, store, compare_supply, "
              "compare_current, compare_rise, tune, clear, store tuning, clear tuning");
  for (const auto& [text, why] :
       {std::pair{"5 knot 0 0 0", "channel '5': must be 1 to 4"},
        std::pair{"1 knot 0.02 0.005",
                  "knot needs three numbers: s after the previous one, m, m/s"},
        std::pair{"1 knot 0.02 0.005 inf",
                  "knot needs three numbers: s after the previous one, m, m/s; 'inf' is not one"},
        std::pair{"1 knot 1e-50 0.005 0",
                  "1e-50 s after the previous one: must be 0.001 or more, or 0 of the first"},
        std::pair{"1 knot 1e300 0.005 0",
                  "1e+300 s after the previous one: must be 0.001 or more, or 0 of the first"},
        std::pair{"1 knot 0.02 0.005 1e300", "1e+300 m/s is not a valid velocity"},
        std::pair{"1 start soon", "start needs a time of the board, in s; 'soon' is not one"},
        std::pair{"1 start 5 6", "start takes no further value: leave out '6'"}}) {
    const auto read = parse_trajectory_command(text, channels);
    CHECK(read && !*read);
    STRCMP_EQUAL(why, read->error().text().c_str());
  }
}

TEST(CommandText, EveryRefusalHasAName) {
  STRCMP_EQUAL("ok", answer_text(Refusal::none, NAN).c_str());
  STRCMP_EQUAL("refused: wrong_state", answer_text(Refusal::wrong_state, NAN).c_str());
  STRCMP_EQUAL("refused: no_such_channel", answer_text(Refusal::no_such_channel, NAN).c_str());
  STRCMP_EQUAL("refused: out_of_range; 0.025 would be obeyed",
               answer_text(Refusal::out_of_range, 0.025).c_str());
}

TEST(CommandText, AnAnswerRoundTrips) {
  for (std::size_t i = 0; i < refusal_names.size(); ++i) {
    const auto refusal = static_cast<Refusal>(i);
    const auto read = parse_answer(answer_text(refusal, NAN));
    CHECK(read && read->refusal == refusal && std::isnan(read->nearest));
  }
  const auto nearest = parse_answer(answer_text(Refusal::out_of_range, 0.025));
  CHECK(nearest && nearest->refusal == Refusal::out_of_range);
  DOUBLES_EQUAL(0.025, nearest->nearest, 0.0);
  const auto reason = parse_answer("refused: unsuitable: kind is unstable on this muscle");
  CHECK(reason && reason->refusal == Refusal::unsuitable && std::isnan(reason->nearest));
  const auto numbered = parse_answer("refused: unsuitable: 3 poles are unstable");
  CHECK(numbered && std::isnan(numbered->nearest));
  for (const char* other :
       {"", "refused: ", "refused: none", "refused: too many clients", "wrong: channel '3'"})
    CHECK_FALSE(parse_answer(other).has_value());
  CHECK(refuses("refused: wrong_state: arm it first", Refusal::wrong_state));
  CHECK_FALSE(refuses("refused: wrong_state", Refusal::not_ready));
  CHECK_FALSE(refuses("ok", Refusal::wrong_state));
}
