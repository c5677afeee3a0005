// Problems of a wrong board configuration: file, line, key, value and what is allowed.
#include <string>

#include <CppUTest/TestHarness.h>
#include <toml++/toml.h>

#include "config/renamed_keys.hpp"
#include "config/section.hpp"
#include "unit/firmware/io/config/support/checked_board.hpp"

using supercoil::test::check_problems;
using supercoil::test::check_replaced;
using supercoil::test::problems_of;
using supercoil::test::small_board;
using supercoil::test::small_board_with;

TEST_GROUP(WrongBoard){};

TEST(WrongBoard, SmallBoardIsValid) {
  STRCMP_EQUAL("", problems_of(small_board).c_str());
}

TEST(WrongBoard, MisspeltRequiredKeyIsReportedOnce) {
  check_replaced("cold_resistance_Ohm", "cold_resistence_Ohm",
                 "b.toml:33: channel[1].heater.cold_resistence_Ohm = 10: is not a key of "
                 "[channel[1].heater]; did you mean cold_resistance_Ohm?");
}

TEST(WrongBoard, MissingUnitIsNamed) {
  check_replaced("max_W = 4.5", "max = 4.5",
                 "b.toml:40: channel[1].limits.max = 4.5: is not a key of [channel[1].limits]; did "
                 "you mean max_W (the unit is part of the name)?");
}

TEST(WrongBoard, RenamedKeyNamesTheNewOne) {
  check_replaced("[[bus]]", "[can]\nmost_load = 0.5\n[[bus]]",
                 "b.toml:11: can.most_load = 0.5: was renamed in 0.2.0: write can.max_load");
  // Reported once, although the new key is required.
  check_replaced("max_m = 0.041", "highest_m = 0.041",
                 "b.toml:27: channel[1].position.highest_m = 0.041: was renamed in 0.2.0: write "
                 "channel[1].position.max_m");
  check_problems(
      "b.toml:44: channel[1].estimator.lowest_part = 0.2: was renamed in 0.2.0: write "
      "channel[1].estimator.min_ratio",
      small_board + "[channel.estimator]\nkind = 'least_squares'\nlowest_part = 0.2\n");
  check_problems(
      "b.toml:43: every_channel.detectors.resistance_part = 0.3: was renamed in 0.2.0: write "
      "every_channel.detectors.resistance_ratio",
      small_board + "[every_channel.detectors]\nresistance_part = 0.3\n");
}

TEST(WrongBoard, ABoardOf0_1_0IsRefusedOnlyForItsRenamedKeys) {
  const auto config = supercoil::config::read_board_config(SUPERCOIL_BOARD_OF_0_1_0);
  CHECK_FALSE(config.has_value());
  UNSIGNED_LONGS_EQUAL(8, config.error().size());
  for (const supercoil::Error& problem : config.error())
    STRCMP_CONTAINS("was renamed in 0.2.0: write ", problem.message.c_str());
}

TEST(WrongBoard, EveryRenamedKeyIsRefusedOnlyInItsTable) {
  for (const supercoil::config::RenamedKey& renamed : supercoil::config::renamed_keys) {
    const std::string key(renamed.old_key);
    const toml::table table{{key, 1.0}};
    const auto answer = [&](const std::string& path) {
      supercoil::config::Diagnostics diagnostics("b.toml");
      supercoil::config::Section(&table, path, diagnostics).finish();
      return diagnostics.problems().at(0).message;
    };
    const std::string path(renamed.table);
    STRCMP_EQUAL(("was renamed in 0.2.0: write " + (path.empty() ? "" : path + ".") +
                  std::string(renamed.key))
                     .c_str(),
                 answer(path).c_str());
    STRCMP_CONTAINS("is not a key of [elsewhere]", answer("elsewhere").c_str());
  }
}

TEST(WrongBoard, ValueOutOfRange) {
  check_replaced("[lines]", "rate_Hz = 50\n[lines]",
                 "b.toml:3: board.rate_Hz = 50: must be 100 to 10000");
}

TEST(WrongBoard, NotANumber) {
  check_replaced("max_W = 4.5", "max_W = nan",
                 "b.toml:40: channel[1].limits.max_W = nan: must be 0.001 to 1000");
}

TEST(WrongBoard, ThermalFuseAtAnImpossibleTemperature) {
  check_replaced("cold_resistance_Ohm = 10.0", "cold_resistance_Ohm = 10.0\nthermal_fuse_C = 45",
                 "b.toml:34: channel[1].heater.thermal_fuse_C = 45: must be 60 to 260, or 0 if "
                 "there is no thermal fuse");
}

TEST(WrongBoard, ABundleWhoseBrokenThreadIsNotDetected) {
  const std::string before = "[channel.heater]\n";
  const auto bundle = [&](const std::string& keys) {
    return "[channel.bundle]\n" + keys + "\n" + before;
  };
  check_replaced(
      before, bundle("muscles = 5\nwired = 'parallel'"),
      "b.toml:33: channel[1].bundle.muscles = 5: with this many in parallel, a broken "
      "thread adds 25 % of resistance, and each of the others gets 1.25 times its share; "
      "detectors.resistance_ratio = 0.3 and heater.temperature_coefficient_per_K let up "
      "to 30 % pass: wire them in series, or lower resistance_ratio");
  // A cold muscle that might be at 160 °C may have 1.3 times 1.29 times its resistance.
  const std::string warm = "temperature_coefficient_per_K = 0.002\n";
  check_replaced(before, bundle("muscles = 3\nwired = 'parallel'") + warm,
                 "b.toml:33: channel[1].bundle.muscles = 3: with this many in parallel, a broken "
                 "thread adds 50 % of resistance, and each of the others gets 1.5 times its share; "
                 "detectors.resistance_ratio = 0.3 and heater.temperature_coefficient_per_K let up "
                 "to 67.7 % pass: wire them in series, or lower resistance_ratio");
  check_replaced(before, bundle("muscles = 1"),
                 "b.toml:33: channel[1].bundle.muscles = 1: must be 2 to 32");
  check_replaced(
      before, bundle("wired = 'parallel'"),
      "b.toml:32: channel[1].bundle.muscles: is missing: it must be a whole number, 2 to 32");
  check_replaced(before, bundle("muscles = 3\nwired = 'both'"),
                 "b.toml:34: channel[1].bundle.wired = 'both': must be one of: series, parallel");
}

TEST(WrongBoard, ABundleOfEveryChannelIsCheckedForEachChannel) {
  const auto problems = [](const std::string& keys) {
    return problems_of(small_board + "[every_channel.bundle]\n" + keys + "\n");
  };
  STRCMP_CONTAINS("every_channel.bundle.muscles = 5: with this many in parallel, a broken thread",
                  problems("muscles = 5\nwired = 'parallel'").c_str());
  STRCMP_CONTAINS(
      "every_channel.bundle.muscle = 3: is not a key of [every_channel.bundle]; did "
      "you mean muscles?",
      problems("muscle = 3").c_str());
}

TEST(WrongBoard, ErrorOfAMassThatWasNotWeighed) {
  check_replaced("min_mass_J_per_K = 0.13",
                 "min_mass_J_per_K = 0.13\nweighed_mass_error_ratio = 0.03",
                 "b.toml:36: channel[1].thermal.weighed_mass_error_ratio = 0.03: needs "
                 "weighed_mass_J_per_K: an assumed mass narrows nothing");
}

TEST(WrongBoard, TimeConstantOutsideTheThermalBounds) {
  check_replaced("min_mass_J_per_K = 0.13", "min_mass_J_per_K = 0.13\nmax_time_constant_s = 0.5",
                 "b.toml:36: channel[1].thermal.max_time_constant_s = 0.5: must not be less than "
                 "min_mass_J_per_K / max_transfer_W_per_K = 0.722222");
}

TEST(WrongBoard, TextForANumber) {
  check_replaced("max_W = 4.5", "max_W = '4.5 W'",
                 "b.toml:40: channel[1].limits.max_W = '4.5 W': must be a number, 0.001 to 1000");
}

TEST(WrongBoard, MissingKeyHasTheLineOfItsTable) {
  check_replaced("cold_resistance_Ohm = 10.0", "",
                 "b.toml:32: channel[1].heater.cold_resistance_Ohm: is missing: it must be a "
                 "number, 0.1 to 10000");
}

TEST(WrongBoard, MissingTableNamesWhatItNeeds) {
  check_replaced("[ambient]\ncoldest_C = 15\nwarmest_C = 30\n", "",
                 "b.toml: ambient: is missing; it needs coldest_C, warmest_C");
}

TEST(WrongBoard, MissingTextDiffersFromEmptyText) {
  check_replaced("line = \"BEAT\"", "",
                 "b.toml:5: lines.heartbeat.line: is missing: it must be text in quotes");
  check_replaced("line = \"BEAT\"", "line = ''",
                 "b.toml:5: lines.heartbeat.line = '': must not be empty");
}

TEST(WrongBoard, SeventeenChannels) {
  std::string text = small_board;
  for (int i = 2; i <= 17; ++i) {
    const std::string n = std::to_string(i);
    for (const char* part :
         {"[[channel]]\nenable = {line = 'EN", "'}\npwm = {device = 'pwm', number = ",
          "}\nposition = {device = 'position', input = 'voltage",
          "'}\ncurrent = {device = 'current', input = 'voltage"}) {
      text += part;
      text += n;
    }
    text += "'}\n";
  }
  text +=
      "[every_channel]\nposition = {m_per_count = 1e-6, min_m = 0.0, max_m = 0.04}\n"
      "current.A_per_count = 0.0001\nheater.cold_resistance_Ohm = 10.0\n"
      "thermal = {min_mass_J_per_K = 0.13, max_mass_J_per_K = 0.2, "
      "min_transfer_W_per_K = 0.045, max_transfer_W_per_K = 0.18}\n"
      "limits = {max_W = 4.5, max_travel_m = 0.025}\n";
  check_problems("b.toml:117: channel: a board has 1 to 16 [[channel]], not 17", text);
}

TEST(WrongBoard, NoChannels) {
  check_problems("b.toml: channel: a board has 1 to 16 [[channel]], not 0",
                 small_board.substr(0, small_board.find("[[channel]]")));
}

TEST(WrongBoard, ThermalBoundsThatDoNotContainTheMuscle) {
  check_replaced("min_mass_J_per_K = 0.13", "min_mass_J_per_K = 0.17",
                 "b.toml:35: channel[1].thermal.min_mass_J_per_K = 0.17: must not exceed the "
                 "believed value: muscle.thermal_mass_J_per_K = 0.162");
  check_replaced("max_transfer_W_per_K = 0.18", "max_transfer_W_per_K = 0.08",
                 "b.toml:38: channel[1].thermal.max_transfer_W_per_K = 0.08: must not be less "
                 "than the believed value: muscle.heat_transfer_W_per_K = 0.089");
}

TEST(WrongBoard, ThermalBoundsOutOfOrder) {
  check_replaced("min_transfer_W_per_K = 0.045", "min_transfer_W_per_K = 0.2",
                 "b.toml:37: channel[1].thermal.min_transfer_W_per_K = 0.2: must be less than "
                 "max_transfer_W_per_K");
}

TEST(WrongBoard, PowerBoundNarrowerThanPossibleSenseErrors) {
  check_replaced("max_transfer_W_per_K = 0.18",
                 "max_transfer_W_per_K = 0.18\npower_part = [0.95, 1.05]",
                 "b.toml:39: channel[1].thermal.power_part = [0.95, 1.05]: contradicts "
                 "detectors.resistance_ratio, below which no error of the senses is noticed; leave "
                 "it out: the bounds of power follow from that until the senses are compared with "
                 "a meter (supercoil doctor --compare-senses)");
}

TEST(WrongBoard, ControllerUnstableOnItsMuscle) {
  check_replaced("max_travel_m = 0.025",
                 "max_travel_m = 0.025\n"
                 "[channel.controller]\nkind = 'pi'\nproportional_W_per_m = 50000.0\n",
                 "b.toml:43: channel[1].controller.kind = 'pi': is unstable on this muscle with 1 "
                 "ms of delay: "
                 "lower its gains, or shorten the delay");
  check_replaced("max_travel_m = 0.025",
                 "max_travel_m = 0.025\n"
                 "[channel.controller]\nkind = 'mrac_ls'\nbandwidth_rad_per_s = 5.0\n",
                 "b.toml:43: channel[1].controller.kind = 'mrac_ls': is unstable on this muscle, "
                 "even when adapted, with 1 ms of delay: lower its "
                 "bandwidth_rad_per_s, or shorten the delay");
}

TEST(WrongBoard, PowerBeyondTheSupply) {
  check_replaced(
      "max_W = 4.5", "max_W = 12.0",
      "b.toml:40: channel[1].limits.max_W = 12: must not exceed what the supply gives at "
      "a duty of 1: min_V²/cold_resistance_Ohm = 11.664 W");
}

TEST(WrongBoard, DeratingThatStartsAboveTheTrip) {
  check_replaced("max_W = 4.5", "max_W = 4.5\nderate_from_C = 165.0",
                 "b.toml:41: channel[1].limits.derate_from_C = 165: must be less than trip_C");
}

TEST(WrongBoard, NearSkinTemperaturesMayNotExceedThePreset) {
  check_replaced("max_W = 4.5", "max_W = 4.5\npreset = 'skin'\ntrip_C = 60.0",
                 "b.toml:42: channel[1].limits.trip_C = 60: must be 0 to 43");
}

TEST(WrongBoard, TravelBeyondTheSensor) {
  check_replaced("max_travel_m = 0.025", "max_travel_m = 0.05",
                 "b.toml:41: channel[1].limits.max_travel_m = 0.05: must be within what the sensor "
                 "can read: position.max_m = 0.041");
}

TEST(WrongBoard, ProbeTooStrongTooLongOrTooSmall) {
  const std::string heater = "cold_resistance_Ohm = 10.0";
  check_replaced(heater, heater + "\nprobe_duty = 0.05",
                 "b.toml:34: channel[1].heater.probe_duty = 0.05: must be 0.0001 to 0.02");
  check_replaced(heater, heater + "\nprobe_ms = 80",
                 "b.toml:34: channel[1].heater.probe_ms = 80: must be 1 to 50");
  check_replaced("number = 0", "number = 0, bits = 5",
                 "b.toml:32: channel[1].heater.probe_duty (its default): is less than one of the "
                 "PWM's 31 steps: a probe would be 0");
}

TEST(WrongBoard, ValuesTooLargeForFixedPoint) {
  const std::string answer = problems_of(
      small_board +
      "[channel.controller]\nkind = 'pi'\narithmetic = 'q8.24'\nproportional_W_per_m = 50000.0\n");
  STRCMP_EQUAL(
      "b.toml:45: channel[1].controller.proportional_W_per_m = 50000: does not fit arithmetic = "
      "\"q8.24\": it is stored as 301.966 there, and must be -127 to 127\n",
      answer.c_str());
}

TEST(WrongBoard, MistakeInEveryChannelIsReportedOnce) {
  const std::string channels = "[[channel]]\n[[channel]]\n";
  const std::string answer =
      problems_of(small_board + channels + "[every_channel.limits]\nmax_w = 3.0\n");
  const std::string message =
      "b.toml:45: every_channel.limits.max_w = 3: is not a key of "
      "[every_channel.limits]; did you mean max_W?\n";
  const std::size_t at = answer.find(message);
  CHECK_TEXT(at != std::string::npos, answer.c_str());
  CHECK_TEXT(answer.find("max_w = 3", at + message.size()) == std::string::npos, answer.c_str());
}

TEST(WrongBoard, MistakesAreReportedInTheOrderOfTheFile) {
  std::string text = small_board_with("charge_pump_decay_ms = 20", "charge_pump_decay_ms = -1");
  text.replace(text.find("max_W = 4.5"), 11, "max_W = 0.0");
  text += "[operator]\nport = 8080\n";
  check_problems(
      "b.toml:2: board.charge_pump_decay_ms = -1: must be 0.1 to 1000\n"
      "b.toml:40: channel[1].limits.max_W = 0: must be 0.001 to 1000\n"
      "b.toml:42: operator: is not a key of this file; its keys are: bus, board, lines, supply, "
      "ambient, command, every_channel, channel, joint, bundle, can",
      text);
}

TEST(WrongBoard, MissingFile) {
  const auto config = supercoil::config::read_board_config("/nowhere/b.toml");
  STRCMP_EQUAL("/nowhere/b.toml: there is no such file\n",
               supercoil::config::to_text(config.error()).c_str());
}
