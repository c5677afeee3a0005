// A reference that no muscle can follow, through the whole firmware.
#include <string>

#include <CppUTest/TestHarness.h>

#include "runner/simulation.hpp"
#include "scenario/read_scenario.hpp"

using namespace supercoil;
using namespace supercoil::host_sim;

namespace {

/// What was told of a fall from 20 to 2 mm, 20 s after the scenario's begin.
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

}  // namespace

TEST_GROUP(Shaping){};

TEST(Shaping, MuscleKeepsToAShapedFallAndItIsSaidWhy) {
  const Fall plain = fall("");
  LONGS_EQUAL(0, plain.cooling);
  CHECK(plain.lacking > 500);
  CHECK(plain.furthest_m > 0.5e-3);
  const Fall shaped = fall("shape_reference = true\n");
  CHECK(shaped.cooling > 500);
  CHECK(shaped.furthest_m < 0.1e-3);
}
