// The steps of setup on a joint, in lockstep: those of its agonist go on with the antagonist.
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <string>

#include <CppUTest/TestHarness.h>
#include <nlohmann/json.hpp>

#include "apps/supercoil/setup/commission.hpp"
#include "config/board_config.hpp"
#include "config/edit_toml.hpp"
#include "runner/use_board.hpp"
#include "scenario/read_scenario.hpp"
#include "setup/listener.hpp"
#include "setup/simulated_link.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

/// slow: the channel, from 0, whose muscle may by its bounds need 20 s until it is cool.
config::BoardConfig example(std::optional<std::size_t> slow = std::nullopt) {
  std::ifstream file(SUPERCOIL_EXAMPLES "/joint-as5600-ads1115.toml");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (slow)
    text = config::with_value(text, "channel", *slow, "thermal.max_mass_J_per_K", "2.0").value();
  auto config = config::parse_board_config(text, "joint.toml");
  if (!config) FAIL(config::to_text(config.error()).c_str());
  return std::move(*config);
}

double gain_m_per_W(const nlohmann::ordered_json& found) {
  const auto value = [&](const char* name) { return found.at(name).get<double>(); };
  return value("force_per_kelvin_N_per_K") /
         (value("stiffness_N_per_m") * value("heat_transfer_W_per_K"));
}

/// The antagonist's heater resistance and force differ from what the file says.
host_sim::Scenario scenario_on(const config::BoardConfig& config) {
  auto scenario = host_sim::parse_scenario(
      "simulation.duration_s = 1e5\noperator.action = 'none'\n[joint]\n"
      "[joint.antagonist]\nresistance_Ohm = 9.5\nforce_per_kelvin_N_per_K = 0.0095\n",
      "joint.toml");
  if (!scenario) FAIL(config::to_text(scenario.error()).c_str());
  const auto used = host_sim::use_board(*scenario, config, 0);
  if (!used) FAIL(used.error().text().c_str());
  return std::move(*scenario);
}

}  // namespace

TEST_GROUP(JointSteps) {
  config::BoardConfig config = example();
  host_sim::Scenario scenario = scenario_on(config);
  host_sim::Simulation simulation{scenario};
  SimulatedLink link{simulation, scenario.rate_Hz};
  Listener listener;
  operating::Commission steps{link, "1", *scenario.board, 0, listener};
};

TEST(JointSteps, MeasuresBothMusclesAndTheJointTracks) {
  const auto calibrated = steps.calibrate();
  CHECK_TRUE(calibrated.has_value());
  DOUBLES_EQUAL(10.0, (*calibrated)["cold_resistance_Ohm"].get<double>(), 0.05);
  DOUBLES_EQUAL(9.5, (*calibrated)["antagonist"]["cold_resistance_Ohm"].get<double>(), 0.05);
  LONGS_EQUAL(2, (*calibrated)["antagonist"]["channel"].get<int>());
  STRCMP_CONTAINS("the antagonist, channel 2:\n", listener.take().c_str());

  const auto found = steps.identify();
  CHECK_TRUE(found.has_value());
  const double believed_m_per_W = 0.0086 / (32.0 * 0.089);
  DOUBLES_EQUAL(1.0, gain_m_per_W(*found) / believed_m_per_W, 0.02);
  DOUBLES_EQUAL(0.0095 / 0.0086, gain_m_per_W((*found)["antagonist"]) / believed_m_per_W, 0.02);
  STRCMP_CONTAINS("identify of channel 2: found\n", listener.take().c_str());

  const auto moved = steps.move();
  CHECK_TRUE(moved.has_value());
  STRCMP_CONTAINS("no error is promised for a joint\n", listener.take().c_str());
  CHECK_FALSE(moved->contains("promised_m"));
  DOUBLES_EQUAL(0.0, (*moved)["error_m"].get<double>(), 20e-6);
  CHECK(link.fault() == Fault::none);
}

TEST(JointSteps, CalibrateWaitsForTheSlowerMuscleToCool) {
  for (const std::size_t slow : {0U, 1U}) {
    const host_sim::Scenario slow_scenario = scenario_on(example(slow));
    host_sim::Simulation slow_simulation{slow_scenario};
    SimulatedLink slow_link{slow_simulation, slow_scenario.rate_Hz};
    const std::string quick = slow == 0 ? "2" : "1";
    operating::Commission quick_muscle{slow_link, quick, *slow_scenario.board, 1 - slow, listener};
    const auto calibrated = quick_muscle.calibrate();
    CHECK_TEXT(calibrated.has_value(), calibrated ? "" : calibrated.error().text().c_str());
    CHECK_COMPARE(slow_link.time_s(), >, 60.0);
  }
}

TEST(JointSteps, TheAntagonistCanBeMeasuredAlone) {
  operating::Commission antagonist{link, "2", *scenario.board, 1, listener};
  const auto calibrated = antagonist.calibrate();
  CHECK_TRUE(calibrated.has_value());
  DOUBLES_EQUAL(9.5, (*calibrated)["cold_resistance_Ohm"].get<double>(), 0.05);
  CHECK_FALSE(calibrated->contains("antagonist"));
}
