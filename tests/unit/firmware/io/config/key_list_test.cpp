// The list of all keys that apply to a file: what --keys prints, and the docs are made from.
#include <algorithm>
#include <string>

#include <CppUTest/TestHarness.h>

#include "config/board_config.hpp"
#include "config/section.hpp"
#include "unit/firmware/io/config/support/small_board.hpp"

using namespace supercoil::config;
using supercoil::test::replaced;
using supercoil::test::small_board;
using supercoil::test::small_board_with;

namespace {

KeyList keys_of(const std::string& board) {
  KeyList keys;
  const auto config = parse_board_config(board, "b.toml", &keys);
  CHECK_TEXT(config.has_value(), config ? "" : to_text(config.error()).c_str());
  return keys;
}

std::size_t times(const KeyList& keys, const std::string& name) {
  return static_cast<std::size_t>(
      std::ranges::count_if(keys, [&](const Key& key) { return key.name == name; }));
}

Key key_of(const KeyList& keys, const std::string& name) {
  const auto found = std::ranges::find(keys, name, &Key::name);
  CHECK_TEXT(found != keys.end(), name.c_str());
  return found == keys.end() ? Key{} : *found;
}

/// The key's line without its columns' padding.
std::string line_of(const std::string& board, const std::string& name) {
  const std::string text = to_text(KeyList{key_of(keys_of(board), name)});
  std::string line = text.substr(text.find('\n') + 1);
  const auto both_spaces = [](char a, char b) { return a == ' ' && b == ' '; };
  line.erase(std::unique(line.begin(), line.end(), both_spaces), line.end());
  return line;
}

}  // namespace

TEST_GROUP(KeyList){};

TEST(KeyList, AbsentKeyHasItsDefaultAndNoLine) {
  STRCMP_EQUAL("board.late_in_a_row 5 5 1 to 1000\n",
               line_of(small_board, "board.late_in_a_row").c_str());
}

TEST(KeyList, GivenKeyHasItsValueAndLine) {
  STRCMP_EQUAL("channel[1].limits.max_W 4.5 required 40 0.001 to 1000\n",
               line_of(small_board, "channel[1].limits.max_W").c_str());
}

TEST(KeyList, DefaultAndRangeFollowOtherKeys) {
  STRCMP_EQUAL("board.late_ms 5 5 0.001 to 10\n",
               line_of(small_board_with("[board]\ncharge_pump_decay_ms = 20",
                                        "[board]\nrate_Hz = 100\ncharge_pump_decay_ms = 200"),
                       "board.late_ms")
                   .c_str());
}

TEST(KeyList, KeyWithoutDefaultIsNone) {
  STRCMP_EQUAL("channel[1].heater.thermal_fuse_C none none 0 to 260\n",
               line_of(small_board, "channel[1].heater.thermal_fuse_C").c_str());
  STRCMP_EQUAL("channel[1].pwm.bits none none 4 to 24\n",
               line_of(small_board, "channel[1].pwm.bits").c_str());
  STRCMP_EQUAL("supply.bus none none\n", line_of(small_board, "supply.bus").c_str());
}

TEST(KeyList, ChoiceHasItsNames) {
  STRCMP_EQUAL("channel[1].limits.preset \"nylon\" \"nylon\" nylon, skin\n",
               line_of(small_board, "channel[1].limits.preset").c_str());
}

TEST(KeyList, IntegerHasAllItsDigits) {
  STRCMP_EQUAL("0 to 2147483647",
               allowed_text({.type = "integer", .range = Range{0.0, 2147483647.0}}).c_str());
}

TEST(KeyList, ListHasItsCount) {
  STRCMP_EQUAL(
      "channel[1].controller.initial [0, 0, 0, 0, 0, 1] [0, 0, 0, 0, 0, 0.3] 43 6 numbers, each "
      "-1000000 to 1000000\n",
      line_of(small_board + "[channel.controller]\ninitial = [0, 0, 0, 0, 0, 1]\n",
              "channel[1].controller.initial")
          .c_str());
}

TEST(KeyList, ListOfTextsOrOfMixedValuesIsShownAsWritten) {
  const toml::table given = toml::parse("a = 'x'\nb = ['x', 2, true]\nc = [1, 0.5]");
  KeyList keys;
  Diagnostics diagnostics("b.toml", &keys);
  Section section(&given, "", diagnostics);
  CHECK(section.texts("a") == std::vector<std::string>{"x"});
  CHECK(section.texts("absent").empty());
  CHECK_EQUAL(std::size_t{3}, section.required_values("b").size());
  section.required_values("c");
  CHECK(diagnostics.empty());
  STRCMP_EQUAL(
      "key     value               default   line  allowed\n"
      "a       [\"x\"]               none      1\n"
      "absent  none                none\n"
      "b       [\"x\", \"2\", \"true\"]  required  2\n"
      "c       [1, 0.5]            required  3\n",
      to_text(keys).c_str());
}

TEST(KeyList, KeyOfEveryChannelHasItsLineThere) {
  const std::string common =
      replaced(small_board, "[channel.heater]\ncold_resistance_Ohm = 10.0\n", "") +
      "[every_channel.heater]\ncold_resistance_Ohm = 10.0\n";
  STRCMP_EQUAL("channel[1].heater.cold_resistance_Ohm 10 required 41 0.1 to 10000\n",
               line_of(common, "channel[1].heater.cold_resistance_Ohm").c_str());
}

TEST(KeyList, EachKeyIsListedOnce) {
  const KeyList keys = keys_of(small_board);
  for (const Key& key : keys)
    CHECK_EQUAL_TEXT(std::size_t{1}, times(keys, key.name), key.name.c_str());
}

TEST(KeyList, NothingIsNotedUnlessAskedFor) {
  const toml::table empty;
  Diagnostics diagnostics("b.toml");
  Section section(&empty, "", diagnostics);
  section.required_number("a", {0.0, 1.0});
  section.optional_integer("b", 0, 1);
  CHECK(diagnostics.keys() == nullptr);
}
