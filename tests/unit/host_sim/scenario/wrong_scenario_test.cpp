// The problems reported for a wrong scenario: file, line, key, value and what is allowed.
#include <string>

#include <CppUTest/TestHarness.h>

#include "scenario/read_scenario.hpp"
#include "unit/host_sim/support/scenarios.hpp"

using namespace supercoil::host_sim;
using supercoil::test::problems;

namespace {

void check_answer(const char* expected, const std::string& text) {
  STRCMP_EQUAL((std::string(expected) + "\n").c_str(), problems(text).c_str());
}

}  // namespace

TEST_GROUP(WrongScenario){};

TEST(WrongScenario, UnknownKeyNamesTheNearestOne) {
  check_answer(
      "s.toml:2: plant.thermal_mas_J_per_K = 0.1: is not a key of [plant]; did you mean "
      "thermal_mass_J_per_K?",
      "[plant]\nthermal_mas_J_per_K = 0.1");
}

TEST(WrongScenario, UnknownTableNamesTheNearestOne) {
  check_answer("s.toml:1: plan: is not a key of this file; did you mean plant?",
               "[plan]\nstiffness_N_per_m = 12.0");
}

TEST(WrongScenario, UnknownKeyWithoutANearOneListsTheKeys) {
  check_answer(
      "s.toml:2: sensor.position.colour = 'red': is not a key of [sensor.position]; its keys are: "
      "noise_rms_m, resolution_bits, range_m, count_m, rate_Hz, min_m",
      "[sensor.position]\ncolour = \"red\"");
}

TEST(WrongScenario, RenamedKeyNamesTheNewOne) {
  check_answer("s.toml:1: trouble: was renamed in 0.2.0: write injected_fault",
               "[trouble]\nheater_open = true");
  check_answer("s.toml:3: trouble: was renamed in 0.2.0: write injected_fault",
               "[[event]]\nat_s = 10.0\ntrouble.heater_open = true");
  check_answer("s.toml:1: operator.wish = 'rest': was renamed in 0.2.0: write operator.action",
               "operator.wish = 'rest'");
  check_answer(
      "s.toml:2: thermal.power_part = [0.9, 1]: was renamed in 0.2.0: write thermal.power_ratio",
      "[thermal]\npower_part = [0.9, 1.0]");
}

TEST(WrongScenario, MissingUnitIsNamed) {
  check_answer(
      "s.toml:2: simulation.duration = 10: is not a key of [simulation]; did you mean duration_s "
      "(the unit is part of the name)?",
      "[simulation]\nduration = 10.0");
}

TEST(WrongScenario, NegativeMassIsRefusedWithTheRange) {
  check_answer("s.toml:2: plant.moving_mass_kg = -0.09: must be 1e-05 to 1000",
               "[plant]\nmoving_mass_kg = -0.09");
}

TEST(WrongScenario, NaNIsOutOfEveryRange) {
  check_answer("s.toml:1: plant.stiffness_N_per_m = nan: must be 0.01 to 1e+06",
               "plant.stiffness_N_per_m = nan");
  check_answer("s.toml:1: power.max_W = inf: must be 0.001 to 1000", "power.max_W = inf");
}

/// No reference could be followed: the forecast would ask for infinite power.
TEST(WrongScenario, PowerThatNeverHeatsIsOutOfRange) {
  check_answer("s.toml:1: power.gain = 0: must be 0.01 to 10", "power.gain = 0.0");
}

TEST(WrongScenario, TextForANumber) {
  check_answer("s.toml:1: power.max_W = '4.5 W': must be a number, 0.001 to 1000",
               "power.max_W = '4.5 W'");
}

TEST(WrongScenario, FractionForAWholeNumber) {
  check_answer("s.toml:1: power.pwm_bits = 12.5: must be a whole number, 0 to 24",
               "power.pwm_bits = 12.5");
}

TEST(WrongScenario, NumberForAFlag) {
  check_answer("s.toml:1: power.error_feedback = 1: must be true or false",
               "power.error_feedback = 1");
}

TEST(WrongScenario, UnknownNameListsTheNames) {
  check_answer(
      "s.toml:1: controller.kind = 'fuzzy': must be one of: power, pi, pd_ff, mrac, "
      "mrac_ls, adaptive_ff, learned_ff",
      "controller.kind = 'fuzzy'");
}

TEST(WrongScenario, MracByLeastSquaresInFixedPoint) {
  check_answer(
      "s.toml:1: controller.arithmetic = 'q8.24': must be double or float: the covariance of "
      "mrac_ls does not fit q8.24",
      "controller = {kind = 'mrac_ls', arithmetic = 'q8.24'}");
}

TEST(WrongScenario, PeriodBothGivenAndToBeFound) {
  check_answer("s.toml:1: controller.find_period = true: must be false where period_s is given",
               "controller = {kind = 'learned_ff', period_s = 25.0, find_period = true}");
}

TEST(WrongScenario, ValueForATable) {
  check_answer("s.toml:1: plant = 3: must be a table: [plant]", "plant = 3");
}

TEST(WrongScenario, TableForAValue) {
  check_answer("s.toml:1: power.max_W: must be a number, 0.001 to 1000", "[power.max_W]\na = 1");
}

TEST(WrongScenario, ListOfTheWrongLength) {
  check_answer(
      "s.toml:1: estimator.gain = [1, 2]: must be a list of 4 numbers, each 1e-06 to 1e+12",
      "estimator.gain = [1.0, 2.0]");
}

TEST(WrongScenario, ListWithAWrongElement) {
  check_answer(
      "s.toml:1: estimator.gain = [1, 2, 3, 'x']: must be a list of 4 numbers, each 1e-06 to "
      "1e+12; 'x' is not",
      "estimator.gain = [1.0, 2.0, 3.0, 'x']");
}

TEST(WrongScenario, SyntaxErrorHasItsLine) {
  const std::string answer = problems("[plant]\nstiffness_N_per_m = = 3\n");
  CHECK_TEXT(answer.starts_with("s.toml:2: is not valid TOML: "), answer.c_str());
}

TEST(WrongScenario, EveryMistakeIsReportedAtOnce) {
  check_answer(
      "s.toml:1: plant.moving_mass_kg = 0: must be 1e-05 to 1000\n"
      "s.toml:2: power.max_W = 5000: must be 0.001 to 1000",
      "plant.moving_mass_kg = 0\npower.max_W = 5000.0\n");
}

TEST(WrongScenario, ReferenceOutOfReach) {
  check_answer(
      "s.toml:1: reference.kind = 'sine': the reference goes up to 50 mm, but "
      "sensor.position.range_m is 40 mm",
      "reference = {kind = 'sine', offset_m = 0.025, amplitude_m = 0.025}");
  check_answer(
      "s.toml:1: reference.kind = 'sine': the reference goes down to -1 mm, but the muscle only "
      "contracts from 0",
      "reference = {kind = 'sine', offset_m = 0.004, amplitude_m = 0.005}");
}

TEST(WrongScenario, PowerBeyondTheSupply) {
  check_answer(
      "s.toml:1: power.max_W = 20: must not exceed what the supply gives at a duty of 1: "
      "supply_V²/resistance_Ohm = 14.4 W",
      "power = {max_W = 20.0, pwm_bits = 12}");
}

TEST(WrongScenario, OpenLoopAndPositionDoNotMix) {
  check_answer("s.toml:1: controller.kind = 'power': open loop needs [reference] kind = \"power\"",
               "controller.kind = 'power'");
  check_answer(
      "s.toml:1: reference.kind = 'power': needs [controller] kind = \"power\": a controller "
      "follows a position",
      "reference.kind = 'power'");
}

TEST(WrongScenario, MracSaysWhichPremiseFails) {
  check_answer(
      "s.toml:2: controller.kind = 'mrac': premise fails: Wm(s)(s+p0)(s+p1) is not strictly "
      "positive real (accept_failed_premises = true runs it anyway)\n"
      "s.toml:2: controller.kind = 'mrac': premise fails: Eq. (12) needs Wm = "
      "k/((s+p0)(s+p1)(s+q0)) (accept_failed_premises = true runs it anyway)",
      "reference_model.kind = 'eq8'\ncontroller.kind = 'mrac'");
  STRCMP_EQUAL("in order", problems("reference_model.kind = 'eq8'\n"
                                    "controller = {kind = 'mrac', accept_failed_premises = true}")
                               .c_str());
}

TEST(WrongScenario, GainsOfMracAreWithinWhatTuneAccepts) {
  const auto with_gain = [](const std::string& gain) {
    return problems("controller = {kind = 'mrac', gain = [" + gain + ", 1, 1, 1, 1, 1]}");
  };
  STRCMP_EQUAL("in order", with_gain("1e12").c_str());
  for (const char* wrong : {"-1.0", "0.0", "2e12"})
    STRCMP_CONTAINS("must be a list of 6 numbers, each 1e-06 to 1e+12", with_gain(wrong).c_str());
}

TEST(WrongScenario, ValuesTooLargeForFixedPoint) {
  // Before these were refused, they silently became other controllers than in double.
  for (const char* text : {
           "controller = {kind = 'pi', arithmetic = 'q8.24', proportional_W_per_m = 50000.0}",
           "controller = {kind='pd_ff', arithmetic='q8.24', derivative_filter_rad_per_s=1000.0}",
           "controller = {arithmetic = 'q8.24', alpha = [1e5, 400.0]}",
           "controller = {arithmetic = 'q8.24', adaptation_scale = 2000.0}",
           "controller = {arithmetic = 'q8.24', initial = [200.0, 0.0, 0.0, 0.0, 0.0, 0.0]}",
           "controller.arithmetic = 'q8.24'\nplant.stiffness_N_per_m = 2000.0",
           "estimator.arithmetic = 'q8.24'\nsimulation.rate_Hz = 100.0",
           "estimator = {arithmetic = 'q8.24', initial = [1e6, 0.0, 0.0, 0.0]}",
           "estimator = {arithmetic = 'q8.24', gain = [1e-6, 1.0, 1.0, 1.0]}",
       }) {
    const std::string answer = problems(text);
    CHECK_TEXT(answer.find("does not fit arithmetic = \"q8.24\"") != std::string::npos,
               (std::string(text) + " -> " + answer).c_str());
  }
}

TEST(WrongScenario, LeastSquaresIsRefusedInFixedPoint) {
  check_answer(
      "s.toml:1: estimator.arithmetic = 'q8.24': must be double or float: the covariance of "
      "least_squares does not fit q8.24",
      "estimator = {kind = 'least_squares', arithmetic = 'q8.24'}");
}

TEST(WrongScenario, AnUnsuitableDefaultIsNamedAsADefault) {
  check_answer(
      "s.toml:1: power.max_W (its default): must not exceed what the supply gives at a duty of 1: "
      "supply_V²/resistance_Ohm = 0.9 W",
      "power = {supply_V = 3.0}");
}

TEST(WrongScenario, RunShorterThanATick) {
  check_answer("s.toml:1: simulation.duration_s = 0.001: must be at least one tick: 1/rate_Hz",
               "simulation = {duration_s = 0.001, rate_Hz = 100.0}");
}

TEST(WrongScenario, PwmWithoutAStepInsideTheLimits) {
  check_answer(
      "s.toml:1: power.pwm_bits = 1: makes the power steps too coarse: one step is 14.4 W, and no "
      "step lies within min_W to max_W",
      "power.pwm_bits = 1");
}

TEST(WrongScenario, PwmWithoutAStepForAProbe) {
  check_answer(
      "s.toml:1: power.pwm_bits = 5: makes the power steps too coarse: a probe's duty, 0.02, is "
      "less than one of 31 steps",
      "power.pwm_bits = 5");
  STRCMP_EQUAL("in order", problems("power.pwm_bits = 6").c_str());
}

TEST(WrongScenario, SensorWithMoreCountsThanAReadingHolds) {
  check_answer("s.toml:1: sensor.position.resolution_bits = 31: must be 0 to 30",
               "sensor.position.resolution_bits = 31");
  check_answer(
      "s.toml:1: sensor.position.count_m = 3e-11: must be 0 or at least the sensor's span over "
      "2^30, 3.72529e-11 m",
      "sensor.position.count_m = 3e-11");
  STRCMP_EQUAL("in order", problems("sensor.position.resolution_bits = 30").c_str());
}

TEST(WrongScenario, KeyWithTensOfThousandsOfParts) {
  std::string text = "a";
  for (int i = 0; i < 40000; ++i)
    text += ".a";
  check_answer("s.toml:1: is longer than 4096 characters", text + " = 1");
}

TEST(WrongScenario, MissingPoles) {
  check_answer(
      "s.toml:1: reference_model.poles_rad_per_s: is missing: it must be a list of 3 "
      "numbers, each 0.001 to 1000",
      "reference_model.kind = 'poles'\ncontroller.kind = 'pi'");
}

TEST(WrongScenario, KeyOfAnotherKindNamesTheDefaultKind) {
  STRCMP_CONTAINS(
      "is not a key of [controller] of kind \"mrac\" (its default); its keys are: kind, ",
      problems("[controller]\nproportional_W_per_m = 3.0").c_str());
  STRCMP_CONTAINS("is not a key of [controller]; its keys are: kind, ",
                  problems("[controller]\nkind = 'pi'\ngain = [1.0]").c_str());
}

TEST(WrongScenario, MissingFile) {
  const auto scenario = read_scenario("/nowhere/s.toml");
  STRCMP_EQUAL("/nowhere/s.toml: there is no such file\n",
               supercoil::config::to_text(scenario.error()).c_str());
}

TEST(WrongScenario, FolderInsteadOfAFile) {
  const auto scenario = read_scenario("/tmp");
  STRCMP_EQUAL("/tmp: is not a file\n", supercoil::config::to_text(scenario.error()).c_str());
}

TEST(WrongScenario, UnknownBuiltInScenario) {
  const auto scenario = read_scenario("sinus");
  STRCMP_EQUAL(
      "sinus: there is no such file, and no built-in scenario has that name; the built-in "
      "scenarios "
      "are: b, bench, "
      "bundle-bench, "
      "bundle, c, disturbances, "
      "first-motion, fixed-point, identify, joint-bench, joint, pwm, real, real_hard, sine, "
      "steps\n",
      supercoil::config::to_text(scenario.error()).c_str());
}
