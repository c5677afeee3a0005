// Whether a board runs with the file that setup uses.
#include "apps/supercoil/setup/running_file.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include <CppUTest/TestHarness.h>

#include "config/board_config.hpp"
#include "config/edit_toml.hpp"
#include "runner/use_board.hpp"
#include "scenario/read_scenario.hpp"
#include "setup/simulated_link.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

std::string text_of(const std::string& example) {
  std::ifstream file(std::string(SUPERCOIL_EXAMPLES "/") + example);
  return {std::istreambuf_iterator<char>(file), {}};
}

config::BoardConfig config_of(const std::string& text) {
  auto config = config::parse_board_config(text, "board.toml");
  if (!config) FAIL(config::to_text(config.error()).c_str());
  return std::move(*config);
}

host_sim::Scenario scenario_of(const config::BoardConfig& config, const std::string& plant) {
  auto scenario = host_sim::parse_scenario(
      "simulation.duration_s = 1e5\noperator.action = 'none'\n" + plant, "scenario.toml");
  if (!scenario) FAIL(config::to_text(scenario.error()).c_str());
  const auto used = host_sim::use_board(*scenario, config, 0);
  if (!used) FAIL(used.error().text().c_str());
  return std::move(*scenario);
}

/// A board that was started with this text.
struct RunningBoard {
  RunningBoard(const std::string& text, const std::string& plant)
      : scenario(scenario_of(config_of(text), plant)) {}
  std::string differences(const std::string& file, std::size_t channel = 0) {
    return operating::differences_of_board(link, 1, config_of(file).settings, channel).value();
  }

  host_sim::Scenario scenario;
  host_sim::Simulation simulation{scenario};
  SimulatedLink link{simulation, scenario.rate_Hz};
};

std::string with(const std::string& text, const std::string& kind, std::size_t at,
                 const std::string& key, const std::string& value) {
  return config::with_value(text, kind, at, key, value).value();
}

}  // namespace

TEST_GROUP(RunningFile){};

TEST(RunningFile, NamesEveryDifferingKeyWithBothValues) {
  const std::string text = text_of("raspberry-pi-pwm-ads1115.toml");
  RunningBoard board(text, "");
  STRCMP_EQUAL("", board.differences(text).c_str());
  STRCMP_EQUAL(
      "channel 1: muscle.stiffness_N_per_m = 20 (the board: 16)",
      board.differences(with(text, "channel", 0, "muscle.stiffness_N_per_m", "20")).c_str());
  STRCMP_EQUAL("channel 1: limits.max_travel_m = 0.02 (the board: 0.025)",
               board.differences(with(text, "channel", 0, "limits.max_travel_m", "0.02")).c_str());
  STRCMP_EQUAL("",
               board.differences(with(text, "channel", 1, "limits.max_travel_m", "0.02")).c_str());
  STRCMP_EQUAL("channel 1: limits.max_W = 1 (the board: 4.5)",
               board.differences(with(text, "channel", 0, "limits.max_W", "1")).c_str());
  STRCMP_EQUAL("channel 1: limits.trip_C = 145 (the board: 160)",
               board.differences(with(text, "channel", 0, "limits.trip_C", "145")).c_str());
  STRCMP_EQUAL(
      "channel 1: thermal.max_mass_J_per_K = 0.3 (the board: 0.2)",
      board.differences(with(text, "channel", 0, "thermal.max_mass_J_per_K", "0.3")).c_str());
  STRCMP_EQUAL(
      "channel 1: heater.cold_resistance_Ohm = 11 (the board: 10)",
      board.differences(with(text, "channel", 0, "heater.cold_resistance_Ohm", "11")).c_str());
}

TEST(RunningFile, IgnoresLearnedValuesAndBusRounding) {
  const config::BoardConfig config = config_of(text_of("raspberry-pi-pwm-ads1115.toml"));
  RunningBoard board(text_of("raspberry-pi-pwm-ads1115.toml"), "");
  KnownMuscle known = board.link.muscle("1").value();
  for (double& value : known)
    value = static_cast<double>(static_cast<float>(value));
  known[2] *= 1.1;
  known[known_cold_resistance] = 9.5;
  CHECK(operating::differences(known, config.settings, 0).empty());
  // An older board reports less, so it cannot be trusted to have the file.
  known[known_max_set_point] = NAN;
  const auto differing = operating::differences(known, config.settings, 0);
  LONGS_EQUAL(1, differing.size());
  STRCMP_CONTAINS("limits.max_travel_m = 0.025 (the board: none)", differing[0].c_str());
}

TEST(RunningFile, ComparesBothMusclesOfAJoint) {
  const std::string text = text_of("joint-as5600-ads1115.toml");
  RunningBoard board(text, "[joint]\n");
  STRCMP_EQUAL("", board.differences(text).c_str());
  const std::string other = with(text, "channel", 1, "muscle.moving_mass_kg", "0.1");
  for (const std::size_t channel : {0U, 1U}) {
    STRCMP_EQUAL("channel 2: muscle.moving_mass_kg = 0.1 (the board: 0.09)",
                 board.differences(other, channel).c_str());
  }
  const std::string lever = with(text, "joint", 0, "lever_m", "0.016");
  STRCMP_CONTAINS("channel 1: [[joint]] lever_m = 0.016 (the board: 0.015)",
                  board.differences(lever).c_str());
}
