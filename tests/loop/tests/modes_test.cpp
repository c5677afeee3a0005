// Identification and calibration.
#include <string>

#include <CppUTest/TestHarness.h>

#include "supercoil/control/actuator/conversions.hpp"

#include "runner/simulation.hpp"
#include "scenario/read_scenario.hpp"

using namespace supercoil;
using namespace supercoil::host_sim;

namespace {

struct Ending {
  std::optional<board::Learned> learned;
  std::string result;
  std::string notes;
  double proportional_W_per_m = 0.0;  ///< the controller's gain, as published last
  double unexplained_ratio = NAN;
};

Ending ending(const std::string& text) {
  const auto scenario = parse_scenario(text, "modes.toml");
  if (!scenario) FAIL(config::to_text(scenario.error()).c_str());
  Simulation simulation(*scenario);
  Ending ended;
  const Snapshot& snapshot = simulation.loop().channel(0).snapshot();
  while (!simulation.done()) {
    simulation.step();
    if (snapshot.result == ModeResult::running && snapshot.progress < 1.0F) {
      LONGS_EQUAL(0, snapshot.identify_notes & ~unsigned{note_friction});
      CHECK(snapshot.progress >= 0.0F && snapshot.progress <= 1.0F);
    }
    if (snapshot.gain.gain == control::Gain::proportional)
      ended.proportional_W_per_m = snapshot.gain.value;
  }
  ended.learned = simulation.learned();
  ended.unexplained_ratio = simulation.loop().channel(0).known(known_unexplained_ratio);
  ended.result = mode_result_names.at(static_cast<std::size_t>(snapshot.result));
  ended.notes = describe_notes(snapshot.identify_notes);
  return ended;
}

/// A run that learned nothing, and why.
Ending check_nothing(const char* why, const std::string& text) {
  Ending ended = ending(text);
  CHECK_FALSE(ended.learned.has_value());
  STRCMP_EQUAL(why, ended.result.c_str());
  return ended;
}

const std::string identify =
    "simulation.duration_s = 300.0\noperator.action = 'identify'\n"
    "[muscle]\nstiffness_N_per_m = 22.0\ndamping_Ns_per_m = 3.0\nthermal_mass_J_per_K = 0.2\n";
const std::string calibrate = "simulation.duration_s = 30.0\noperator.action = 'calibrate'\n";

}  // namespace

TEST_GROUP(Modes){};

TEST(Modes, IdentifyFindsTheMuscleWithinAMinute) {
  for (const int seed : {1, 2, 3, 4, 5}) {
    const auto found =
        ending("simulation.seed = " + std::to_string(seed) + "\n" + identify).learned;
    CHECK(found.has_value());
    DOUBLES_EQUAL(16.0, found->muscle.stiffness_N_per_m, 0.02 * 16.0);
    DOUBLES_EQUAL(0.162, found->muscle.thermal_mass_J_per_K, 0.03 * 0.162);
    DOUBLES_EQUAL(0.089, found->muscle.heat_transfer_W_per_K, 0.02 * 0.089);
    DOUBLES_EQUAL(2.0, found->muscle.damping_Ns_per_m, 0.04 * 2.0);
  }
}

TEST(Modes, DerivedGainsUseTheIdentifiedMuscle) {
  const Ending ended = ending(
      identify +
      "[controller]\nkind = 'adaptive_ff'\n[[event]]\nat_s = 83.0\noperator.action = 'track'\n");
  CHECK(ended.learned.has_value());
  const control::AdaptiveFeedforwardSettings settings;
  const double theta3 = control::theta_from(ended.learned->muscle)[2];
  DOUBLES_EQUAL(settings.bandwidth_rad_per_s * theta3, ended.proportional_W_per_m, 1e-6);
  // The configured values are another muscle's; with them it would be a third more.
  DOUBLES_EQUAL(8.0 * 322.09, ended.proportional_W_per_m, 0.05 * 8.0 * 322.09);
}

TEST(Modes, IdentifyMeasuresTheResponseRatioOfSmallMotions) {
  const Ending smooth = ending(identify);
  CHECK(smooth.learned.has_value());
  DOUBLES_EQUAL(1.0, smooth.learned->response_ratio, 0.06);
  STRCMP_EQUAL("", smooth.notes.c_str());
  struct Rubbing {
    double friction_ratio;
    double min_answer_ratio;
    double max_answer_ratio;
  };
  for (const auto& [friction, min_ratio, max_ratio] :
       {Rubbing{0.002, 0.1, 0.3}, Rubbing{0.01, 0.001, 0.05}}) {
    const Ending rough =
        ending(identify + "[plant]\nfriction_ratio = " + std::to_string(friction) + "\n");
    CHECK(rough.learned.has_value());
    printf("friction %g: %.3f of a small motion\n", friction, rough.learned->response_ratio);
    CHECK_COMPARE(rough.learned->response_ratio, >=, min_ratio);
    CHECK_COMPARE(rough.learned->response_ratio, <=, max_ratio);
    STRCMP_CONTAINS("friction", rough.notes.c_str());
  }
}

/// The first strokes do not fit one muscle, so shorter ones follow: they find the present muscle.
TEST(Modes, IdentifyFindsTheMuscleAfterAChange) {
  for (const int at_s : {20, 28, 36, 44}) {
    const Ending ended = ending(identify + "[[event]]\nat_s = " + std::to_string(at_s) +
                                "\nplant.stiffness_N_per_m = 11.0\n");
    STRCMP_EQUAL("found", ended.result.c_str());
    STRCMP_CONTAINS("poor_fit", ended.notes.c_str());
    CHECK(ended.unexplained_ratio > 0.06);  // of the full strokes
    DOUBLES_EQUAL(ended.unexplained_ratio, ended.learned->unexplained_ratio, 0.0);
    CHECK(ended.learned->identification.found());
    DOUBLES_EQUAL(0.0, ended.learned->identification.identified_s, 0.0);  // no calendar time
    control::PhysicalParameters softened;
    softened.stiffness_N_per_m = 11.0;
    const control::Theta truth = control::theta_from(softened);
    const control::Theta found = control::theta_from(ended.learned->muscle);
    for (int i = 1; i < 4; ++i)
      DOUBLES_EQUAL(truth[i], found[i], 0.02 * truth[i]);
  }
}

TEST(Modes, IdentifyStoresNothingWhenTheMuscleKeepsChanging) {
  for (const int at_s : {20, 28, 36, 44}) {
    std::string events;
    for (int i = 0; i < 30; ++i) {
      events += "[[event]]\nat_s = " + std::to_string(at_s + 8 * i) +
                "\nplant.stiffness_N_per_m = " + (i % 2 == 0 ? "10.0" : "17.0") + "\n";
    }
    check_nothing("poor_fit", identify + events);
  }
}

/// A time constant of 270 s: after the full strokes there is no time for enough shorter ones.
TEST(Modes, PoorFitIsReportedEvenIfShorterStrokesDoNotHelp) {
  const Ending ended = check_nothing(
      "poor_fit",
      "simulation.duration_s = 2600.0\noperator.action = 'identify'\n[plant]\n"
      "thermal_mass_J_per_K = 24.0\n[[event]]\nat_s = 1700.0\nplant.stiffness_N_per_m = 11.0\n");
  STRCMP_CONTAINS("theta3_uncertain", ended.notes.c_str());
}

TEST(Modes, IdentifyStoresNothingWhenTheMuscleIsImplausible) {
  const Ending ended = check_nothing("implausible",
                                     "simulation.duration_s = 85.0\noperator.action = 'identify'\n"
                                     "[muscle]\nstiffness_N_per_m = 200.0\n");
  STRCMP_EQUAL("implausible", ended.notes.c_str());
}

TEST(Modes, IdentifyFindsTheMuscleThroughNoise) {
  const Ending ended = ending(identify + "[sensor.position]\nnoise_rms_m = 1e-3\n");
  CHECK(ended.learned.has_value());
  const control::Theta truth = control::theta_from(control::PhysicalParameters{});
  const control::Theta found = control::theta_from(ended.learned->muscle);
  for (int i = 1; i < 4; ++i)
    DOUBLES_EQUAL(truth[i], found[i], 0.08 * truth[i]);
}

TEST(Modes, IdentifyKeepsTheConfiguredTheta1WhenItIsUncertain) {
  const Ending ended =
      ending(identify + "[sensor.position]\nnoise_rms_m = 4e-3\nresolution_bits = 10\n");
  STRCMP_EQUAL("found", ended.result.c_str());
  STRCMP_EQUAL("theta1_kept", ended.notes.c_str());
  // θ1/θ3 is the believed muscle's.
  control::PhysicalParameters believed;
  believed.stiffness_N_per_m = 22.0;
  believed.damping_Ns_per_m = 3.0;
  believed.thermal_mass_J_per_K = 0.2;
  const control::Theta expected = control::theta_from(believed);
  const control::Theta found = control::theta_from(ended.learned->muscle);
  DOUBLES_EQUAL(expected[0] / expected[2], found[0] / found[2], 1e-6);
}

TEST(Modes, IdentifyReportsEveryReasonWhenTheSensorIsTooNoisy) {
  const Ending ended = check_nothing(
      "poor_fit",
      identify +
          "[power]\nmax_W = 0.5\n[sensor.position]\nnoise_rms_m = 2e-3\nresolution_bits = 10\n");
  STRCMP_EQUAL("theta2_uncertain, theta3_uncertain, theta4_uncertain, poor_fit",
               ended.notes.c_str());
}

TEST(Modes, IdentifyStoresNothingWhenTheMuscleHardlyMoves) {
  const Ending ended = check_nothing("too_little_motion", identify + "[power]\nmax_W = 0.05\n");
  STRCMP_EQUAL("too_little_motion", ended.notes.c_str());
}

TEST(Modes, IdentifyStoresNothingWhenCommandsStop) {
  check_nothing("interrupted",
                identify + "[[event]]\nat_s = 30.0\ninjected_fault.commands_stop = true\n");
}

TEST(Modes, CalibrateFindsZeroAndColdResistance) {
  // The load pulls the resting muscle to −3.1 mm, which the sensor sees as 0: so it is raised.
  const Ending ended = ending(calibrate + "[plant]\nload_N = -0.05\nresistance_Ohm = 9.5\n");
  const auto& found = ended.learned;
  CHECK(found.has_value());
  STRCMP_EQUAL("found", ended.result.c_str());
  DOUBLES_EQUAL(0.05 / 16.0, found->calibration.position_offset_m, 5e-6);
  DOUBLES_EQUAL(9.5, found->calibration.cold_resistance_Ohm, 0.05);
}

/// Except for a heater whose resistance tells its temperature, or a sensor with too few steps to
/// show a motion of half a millimetre.
TEST(Modes, AStillMuscleNeedNotBeColdForItsZero) {
  const auto hottest_C = [](const std::string& plant) {
    const auto scenario = parse_scenario(calibrate + "[plant]\n" + plant, "modes.toml");
    if (!scenario) FAIL(config::to_text(scenario.error()).c_str());
    Simulation simulation(*scenario);
    const Snapshot& snapshot = simulation.loop().channel(0).snapshot();
    while (snapshot.result != ModeResult::found && !simulation.done())
      simulation.step();
    CHECK(snapshot.result == ModeResult::found);
    return snapshot.hottest_C;
  };
  const double warmest_C = board::AirSettings{}.warmest_C;
  // Averaging for a second and the probe follow.
  CHECK_COMPARE(hottest_C(""), >, warmest_C + 4.0);
  CHECK_COMPARE(hottest_C(""), <, warmest_C + 20.0);
  CHECK_COMPARE(hottest_C("temperature_coefficient_per_K = 0.002\n"), <, warmest_C + 1.0);
  CHECK_COMPARE(hottest_C("[sensor.position]\nresolution_bits = 6\n"), <, warmest_C + 1.0);
}

TEST(Modes, CalibrateStoresNothingWhileTheMuscleMoves) {
  check_nothing("moved", calibrate + "[[event]]\nat_s = 2.4\nplant.load_N = -0.05\n");
}
