// identify on muscles whose parameters the board believes up to 50 % too high or too low. More
// seeds, and the figures of docs/identify-theory.md: identify_figures.
#include <cmath>
#include <cstdlib>
#include <string>

#include <CppUTest/TestHarness.h>

#include "supercoil/control/actuator/conversions.hpp"

#include "loop/support/identified_muscle.hpp"
#include "scenario/read_scenario.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

constexpr double sensor_travel_m = 0.04;
constexpr double hottest_allowed_C = 160.0;

std::string described(const MuscleKind& kind, int seed, const Identified& run) {
  return std::string(kind.name) + ", seed " + std::to_string(seed) + ": " +
         std::string(mode_result_names.at(static_cast<std::size_t>(run.result))) + " (" +
         describe_notes(run.notes) + ")";
}

int seeds() {
  const char* fewer = std::getenv("SUPERCOIL_SEEDS");
  return fewer ? std::atoi(fewer) : 3;
}

bool is_linear(const MuscleKind& kind) {
  return kind.name == "paper" || kind.plant.find("preset") == std::string_view::npos;
}

}  // namespace

TEST_GROUP(Identify){};

TEST(Identify, FindsEveryMuscleWithinTravelAndTemperatureLimits) {
  for (const MuscleKind& kind : muscle_kinds) {
    for (int seed = 1; seed <= seeds(); ++seed) {
      const Identified run = run_identify(kind, seed);
      const std::string text = described(kind, seed, run);
      LONGS_EQUAL_TEXT(static_cast<int>(ModeResult::found), static_cast<int>(run.result),
                       text.c_str());
      CHECK_TEXT(run.max_m < 0.6 * sensor_travel_m, text.c_str());
      CHECK_TEXT(run.min_m >= 0.0, text.c_str());
      CHECK_TEXT(run.hottest_published_C < hottest_allowed_C, text.c_str());
      const control::Theta truth = control::theta_from(run.truth);
      const control::Theta found = control::theta_from(run.learned->muscle);
      for (int i = 1; i < 4 && is_linear(kind); ++i)
        DOUBLES_EQUAL_TEXT(1.0, found[i] / truth[i], 0.02, text.c_str());
    }
  }
}

/// Nine strokes of a muscle with a time constant of 20 s take 570 s.
TEST(Identify, EndsWhenASlowMuscleIsFound) {
  for (const MuscleKind& kind : muscle_kinds) {
    if (kind.name != "slow, 20 s") continue;
    const Identified run = run_identify(kind, 1);
    const std::string text = described(kind, 1, run);
    LONGS_EQUAL_TEXT(static_cast<int>(ModeResult::found), static_cast<int>(run.result),
                     text.c_str());
    CHECK_COMPARE_TEXT(run.took_s, <, 430.0, text.c_str());
  }
}

/// Seven strokes of 3 mm leave θ2 and θ4 of such a muscle uncertain; fifteen do not.
TEST(Identify, ContinuesWhileTheMuscleIsUncertain) {
  const auto scenario = host_sim::parse_scenario(
      "simulation.seed = 12\nsimulation.duration_s = 300.0\noperator.action = 'identify'\n"
      "plant.preset = 'real'\nsensor.position.noise_rms_m = 5.2e-6\npower.pwm_bits = 12\n"
      "[thermal]\nmass_ratio = [0.45, 2.5]\ntransfer_ratio = [0.3, 4.4]\n"
      "[joint]\npretension_N = 0.4\nantagonist.preset = 'real'\n",
      "joint.toml");
  CHECK(scenario.has_value());
  host_sim::Simulation simulation(*scenario);
  double took_s = 0.0;
  while (!simulation.done() && !simulation.learned(0))
    took_s = simulation.step().time_s;
  const Snapshot& ended = simulation.loop().channel(0).snapshot();
  CHECK_TEXT(simulation.learned(0).has_value(), describe_notes(ended.identify_notes).c_str());
  CHECK_COMPARE(took_s, >, 70.0);
}

/// A slow muscle that needs little power for its whole travel: a dither that its sensor could see
/// needs more.
TEST(Identify, StaysWithinTheShortTravelOfAStrongMuscle) {
  const auto scenario = host_sim::parse_scenario(
      "simulation.duration_s = 300.0\noperator.action = 'identify'\n"
      "[plant]\nthermal_mass_J_per_K = 0.9\nheat_transfer_W_per_K = 0.06\n"
      "stiffness_N_per_m = 6.5\nforce_per_kelvin_N_per_K = 0.03\n"
      "[reference]\noffset_m = 0.004\namplitude_m = 0.001\n"
      "[sensor.position]\nnoise_rms_m = 3e-6\nrange_m = 0.008\n",
      "strong.toml");
  CHECK(scenario.has_value());
  host_sim::Simulation simulation(*scenario);
  double max_m = 0.0;
  while (!simulation.done() && !simulation.learned(0))
    max_m = std::fmax(max_m, simulation.step().position_m);
  CHECK(simulation.learned(0).has_value());
  CHECK_COMPARE(max_m, <, 0.006);
}

TEST(Identify, LearnedFeedforwardTracksAfterIdentify) {
  for (const std::string_view name : {"real", "stiff", "lightly damped"}) {
    for (const MuscleKind& kind : muscle_kinds) {
      if (kind.name != name) continue;
      const double rms_m = tracking_after(kind, 1);
      CHECK_TEXT(rms_m < 25e-6, kind.name.data());
    }
  }
}
