// A reference that no muscle can follow, through the whole firmware.
#include <string>

#include <CppUTest/TestHarness.h>

#include "loop/feasibility.hpp"
#include "runner/board_of.hpp"
#include "runner/simulation.hpp"
#include "scenario/read_scenario.hpp"

using namespace supercoil;
using namespace supercoil::host_sim;

namespace {

/// What was reported about a fall from 20 to 2 mm, 20 s after the scenario began.
struct Fall {
  int cooling = 0;        ///< ticks limited by it
  int lacking = 0;        ///< ticks in which more cold was wanted than there is
  double furthest_m = 0;  ///< of the muscle from the model
};

Fall fall(const std::string& controller) {
  const auto scenario = parse_scenario(
      "simulation.duration_s = 40.0\n"
      "[reference]\nkind = 'steps'\nlevels_m = [0.020, 0.002]\nhold_s = 20.0\n"
      "[reference_model]\nkind = 'wm16'\n[estimator]\nkind = 'least_squares'\n"
      "[controller]\nkind = 'adaptive_ff'\n" +
          controller,
      "shaping.toml");
  if (!scenario) FAIL(config::to_text(scenario.error()).c_str());
  Simulation simulation(*scenario);
  Fall fall;
  while (!simulation.done()) {
    simulation.step();
    const Snapshot& s = simulation.loop().channel(0).snapshot();
    if (hal::seconds(s.time - simulation.start()) < 20.0) continue;
    fall.cooling += static_cast<int>(s.limited_by == LimitedBy::cooling);
    fall.lacking += static_cast<int>(s.limited);
    fall.furthest_m = std::fmax(fall.furthest_m, std::abs(s.position_m - s.model_m));
  }
  return fall;
}

/// What was reported about a set point that is more than can be held indefinitely.
struct Held {
  Fault fault = Fault::none;
  double highest_m = 0.0;   ///< of the model
  double last_m = 0.0;      ///< of it, at the end
  double furthest_m = 0.0;  ///< of the muscle from the model, once it has come up
  LimitedBy by = LimitedBy::nothing;
};

Held held_at(double set_point_m, const std::string& conditions, bool identified = false) {
  auto scenario = parse_scenario(
      "simulation.duration_s = 200.0\n"
      "reference = {kind = 'steps', levels_m = [" +
          std::to_string(set_point_m) +
          "], hold_s = 500.0}\n"
          "controller = {kind = 'learned_ff', shape_reference = true}\n" +
          conditions,
      "held.toml");
  if (!scenario) FAIL(config::to_text(scenario.error()).c_str());
  scenario->known[0].muscle_identified = identified;
  Simulation simulation(*scenario);
  Held held;
  while (!simulation.done()) {
    simulation.step();
    const Snapshot& s = simulation.loop().channel(0).snapshot();
    held.fault = s.fault;
    held.highest_m = std::fmax(held.highest_m, s.model_m);
    held.last_m = s.model_m;
    held.by = s.limited_by;
    if (hal::seconds(s.time - simulation.start()) > 20.0)
      held.furthest_m = std::fmax(held.furthest_m, std::abs(s.position_m - s.model_m));
  }
  return held;
}

double believed_held_m(const std::string& conditions, bool identified = false) {
  auto scenario = parse_scenario(conditions, "held.toml");
  if (!scenario) FAIL(config::to_text(scenario.error()).c_str());
  scenario->known[0].muscle_identified = identified;
  const BoardSettings board = firmware_of(*scenario);
  return feasibility(board.channels[0], board).travel_m;
}

}  // namespace

TEST_GROUP(Shaping){};

TEST(Shaping, MuscleFollowsAShapedFallLimitedByCooling) {
  const Fall plain = fall("");
  LONGS_EQUAL(0, plain.cooling);
  CHECK(plain.lacking > 500);
  CHECK(plain.furthest_m > 0.5e-3);
  const Fall shaped = fall("shape_reference = true\n");
  CHECK(shaped.cooling > 500);
  CHECK(shaped.furthest_m < 0.1e-3);
}

/// The model goes there for as long as the heat allows, and then returns to what can be held.
TEST(Shaping, ReferenceIsLimitedToWhatTheTemperatureAllows) {
  const Held held = held_at(0.027, "");
  CHECK(held.fault == Fault::none);
  CHECK(held.by == LimitedBy::temperature);
  CHECK(held.highest_m > 1.05 * believed_held_m(""));
  DOUBLES_EQUAL(believed_held_m(""), held.last_m, 0.1e-3);
  CHECK(held.furthest_m < 0.1e-3);
}

TEST(Shaping, ReferenceIsLimitedToWhatTheProofAllows) {
  const std::string noisy =
      "thermal.power_ratio = [0.75, 1.0]\nsensor.position.noise_rms_m = 100e-6\n";
  const Held held = held_at(0.011, noisy, true);
  CHECK(held.fault == Fault::none);
  CHECK(held.by == LimitedBy::unproven);
  DOUBLES_EQUAL(believed_held_m(noisy, true), held.last_m, 0.1e-3);
  CHECK(held.furthest_m < 0.8e-3);  // includes the sensor's own noise
}

/// A muscle that does not do what its model does is not the reference's fault, and is still found.
TEST(Shaping, AWeakerMuscleThanConfiguredIsStillDetected) {
  const Held held = held_at(
      0.027, "plant.force_per_kelvin_N_per_K = 0.0077\nmuscle.force_per_kelvin_N_per_K = 0.0086\n");
  CHECK(held.fault == Fault::controller_invalid);
}
