#include "config/edit_toml.hpp"

#include <fstream>
#include <iterator>
#include <string>

#include <CppUTest/TestHarness.h>

#include "config/board_config.hpp"

using namespace supercoil::config;

namespace {

std::string text_of_example(const std::string& name) {
  std::ifstream file(std::string(SUPERCOIL_EXAMPLES) + "/" + name + ".toml");
  return {std::istreambuf_iterator<char>(file), {}};
}

void check_edit(const std::string& before, std::size_t channel, const std::string& path,
                const std::string& literal, const std::string& after) {
  const auto edited = with_value(before, "channel", channel, path, literal);
  CHECK_TRUE_TEXT(edited.has_value(), edited ? "" : edited.error().text().c_str());
  STRCMP_EQUAL(after.c_str(), edited->c_str());
}

std::string why_not(const std::string& text, std::size_t channel, const std::string& path,
                    const std::string& literal) {
  const auto edited = with_value(text, "channel", channel, path, literal);
  CHECK_FALSE(edited.has_value());
  return edited.error().text();
}

}  // namespace

TEST_GROUP(EditToml){};

TEST(EditToml, ReplacesAValueInPlaceAndKeepsItsComment) {
  check_edit("[[channel]]\nlimits.max_W = 4.5   # µW? no\nname = 'a'\n", 0, "limits.max_W", "3.25",
             "[[channel]]\nlimits.max_W = 3.25   # µW? no\nname = 'a'\n");
}

TEST(EditToml, HandlesMultiByteCharacters) {
  check_edit("[[channel]]\nlimits = { note = 'Ω µ °', max_W = 4.5 } # Ω\n", 0, "limits.max_W", "2",
             "[[channel]]\nlimits = { note = 'Ω µ °', max_W = 2 } # Ω\n");
}

TEST(EditToml, AddsAKeyToATableInAnyForm) {
  check_edit("[[channel]]\nlimits = { max_W = 1 }\n", 0, "limits.max_travel_m", "0.01",
             "[[channel]]\nlimits = { max_W = 1, max_travel_m = 0.01 }\n");
  check_edit("[[channel]]\nlimits = {}\n", 0, "limits.max_W", "1",
             "[[channel]]\nlimits = { max_W = 1}\n");
  check_edit("[[channel]]\nname = 'a'\nlimits.max_W = 1\n", 0, "limits.max_travel_m", "0.01",
             "[[channel]]\nname = 'a'\nlimits.max_W = 1\nlimits.max_travel_m = 0.01\n");
  check_edit("[[channel]]\nname = 'a'\n[channel.limits]\nmax_W = 1", 0, "limits.max_travel_m",
             "0.01", "[[channel]]\nname = 'a'\n[channel.limits]\nmax_travel_m = 0.01\nmax_W = 1");
}

TEST(EditToml, AMissingTableIsAddedAtTheStartOfItsChannel) {
  check_edit(
      "# board\n[[channel]]\nname = 'a'\n[[channel]]\nname = 'b'\n", 1, "muscle.damping_Ns_per_m",
      "2",
      "# board\n[[channel]]\nname = 'a'\n[[channel]]\nmuscle.damping_Ns_per_m = 2\nname = 'b'\n");
}

TEST(EditToml, AWholeTableCanBeReplaced) {
  check_edit("[[channel]]\ncontroller = { kind = 'pi', proportional_W_per_m = 3 } # mine\n", 0,
             "controller", "{ kind = 'mrac' }",
             "[[channel]]\ncontroller = { kind = 'mrac' } # mine\n");
}

TEST(EditToml, RefusesInvalidTomlAndImpossibleEdits) {
  const std::string two = "[[channel]]\nname = 'a'\n[[channel.controller]]\nkind = 'pi'\n";
  STRCMP_CONTAINS("there is no channel 2", why_not(two, 1, "limits.max_W", "1").c_str());
  STRCMP_CONTAINS("limits.max_W = 1 kW", why_not(two, 0, "limits.max_W", "1 kW").c_str());
  STRCMP_CONTAINS("cannot redefine existing table",
                  why_not("[[channel]]\nlimits = 3\n", 0, "limits.max_W", "1").c_str());
  STRCMP_CONTAINS("limits.max_W", why_not("[[channel]\n", 0, "limits.max_W", "1").c_str());
}

/// Each example remains a valid board, and the rest of it is unchanged.
TEST(EditToml, EveryExampleAcceptsANewMuscle) {
  for (const char* name :
       {"raspberry-pi-pwm-ads1115", "raspberry-pi-pca9685-ads1115", "on-chip-pwm-fast-converter"}) {
    const auto before = parse_board_config(text_of_example(name), name);
    const std::size_t last = before->settings.channels.size() - 1;
    std::string text = text_of_example(name);
    for (const auto& [path, literal] :
         {std::pair{"limits.max_W", "0.75"}, std::pair{"muscle.stiffness_N_per_m", "21.5"},
          std::pair{"heater.cold_resistance_Ohm", "9.5"},
          std::pair{"controller", "{ kind = \"learned_ff\" }"}}) {
      const auto edited = with_value(text, "channel", last, path, literal);
      CHECK_TRUE_TEXT(edited.has_value(), edited ? "" : edited.error().text().c_str());
      text = *edited;
    }
    const auto after = parse_board_config(text, name);
    CHECK_TRUE(after.has_value());
    const supercoil::ChannelSettings& channel = after->settings.channels[last];
    DOUBLES_EQUAL(0.75, channel.limiter.max_W, 0.0);
    DOUBLES_EQUAL(21.5, channel.muscle.stiffness_N_per_m, 0.0);
    DOUBLES_EQUAL(9.5, channel.heater.cold_resistance_Ohm, 0.0);
    LONGS_EQUAL(1, channel.controllers.size());
    DOUBLES_EQUAL(before->settings.channels[0].limiter.max_W,
                  after->settings.channels[0].limiter.max_W, 0.0);
    CHECK(after->labels[last].name == before->labels[last].name);
  }
}
