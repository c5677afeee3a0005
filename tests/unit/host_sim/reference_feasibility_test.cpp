// Whether a reference can be followed, predicted before it is run.
#include "runner/reference_feasibility.hpp"

#include <cmath>
#include <cstdio>
#include <string>

#include <CppUTest/TestHarness.h>

#include "runner/summary.hpp"
#include "unit/host_sim/support/scenarios.hpp"

using namespace supercoil;
using namespace supercoil::host_sim;
using supercoil::test::read;

namespace {

/// The heat needs 22 s to follow a power, and the reference demands it in 4 s.
const std::string slow =
    "simulation.duration_s = 120.0\n[plant]\nthermal_mass_J_per_K = 2.0\n"
    "[muscle]\nthermal_mass_J_per_K = 2.0\n[controller]\nkind = 'learned_ff'\n";

std::string described(const Scenario& scenario) {
  return describe_reference(reference_feasibility(scenario), scenario);
}

double infeasible_ratio(const Scenario& scenario) {
  return reference_feasibility(scenario)->infeasible_ratio;
}

/// The infeasible time as the controller counts it in a run.
InfeasibleTime found_in_run(const Scenario& scenario) {
  Simulation simulation(scenario);
  Summary summary({});
  while (!simulation.done())
    summary.add(simulation.step());
  return *summary.infeasible();
}

double infeasible_ratio_of_run(const Scenario& scenario) {
  return found_in_run(scenario).ratio();
}

}  // namespace

TEST_GROUP(ReferenceFeasibility){};

TEST(ReferenceFeasibility, TheDefaultsAreFeasible) {
  const auto f = reference_feasibility(read(""));
  CHECK_TRUE(f.has_value());
  CHECK_TRUE(f->feasible());
  DOUBLES_EQUAL(0.0, f->infeasible_ratio, 0.001);
  DOUBLES_EQUAL(1.0, f->feasible_motion_ratio, 0.0);
  STRCMP_CONTAINS("no more than", described(read("")).c_str());
}

TEST(ReferenceFeasibility, ASlowMusclesSineIsAsFeasibleAsReported) {
  Scenario scenario = read(slow);
  const auto f = reference_feasibility(scenario);
  CHECK_COMPARE(f->infeasible_ratio, >, 0.5);
  CHECK_COMPARE(f->feasible_motion_ratio, <, 0.5);
  CHECK_COMPARE(f->feasible_slowing, >, 3.0);
  CHECK_COMPARE(f->feasible_slowing, <, 20.0);
  const Reference reference = scenario.start.reference;
  const auto with = [&](double amplitude_ratio, double slowing) {
    scenario.duration_s = 2000.0;
    scenario.start.reference = reference;
    scenario.start.reference.terms[0].amplitude *= amplitude_ratio;
    scenario.start.reference.terms[0].angular_frequency_rad_per_s /= slowing;
    return infeasible_ratio(scenario);
  };
  // What remains is the way from rest to the middle.
  const double coming_up = 0.01;
  CHECK_COMPARE(with(0.99 * f->feasible_motion_ratio, 1.0), <, coming_up);
  CHECK_COMPARE(with(1.05 * f->feasible_motion_ratio, 1.0), >, 5.0 * coming_up);
  CHECK_COMPARE(with(1.0, f->feasible_slowing), <, coming_up);
  CHECK_COMPARE(with(1.0, 0.9 * f->feasible_slowing), >, 2.0 * coming_up);
  const std::string text = described(read(slow));
  STRCMP_CONTAINS(
      "0.224 of its motion about the middle is feasible, or all of it 7.99 times as slow",
      text.c_str());
  STRCMP_CONTAINS("with shape_reference = true", text.c_str());
  const Scenario shaped = read(slow + "shape_reference = true\n");
  STRCMP_CONTAINS("; it is shaped", described(shaped).c_str());
}

/// The controller uses the same muscle.
TEST(ReferenceFeasibility, AgreesWithWhatARunFinds) {
  const Scenario scenario = read(
      "simulation.duration_s = 100.0\nplant.thermal_mass_J_per_K = 0.5\n"
      "muscle.thermal_mass_J_per_K = 0.5\nreference.angular_frequency_rad_per_s = 0.5\n"
      "[controller]\nkind = 'learned_ff'\nlearn = false\nshape_reference = true\n");
  const double found = infeasible_ratio_of_run(scenario);
  printf("found %g, predicted %g\n", found, infeasible_ratio(scenario));
  CHECK_COMPARE(found, >, 0.05);
  CHECK_COMPARE(infeasible_ratio(scenario), >, 0.5 * found);
  CHECK_COMPARE(infeasible_ratio(scenario), <, 1.5 * found);
}

/// Badly cooled according to its board's bounds: at rest it may be too hot for 18 mm.
TEST(ReferenceFeasibility, ReportsASetPointThatMayBecomeTooHotToHold) {
  const std::string hot =
      "simulation.duration_s = 100.0\n[thermal]\ntransfer_ratio = [0.25, 2.2]\n"
      "power_ratio = [1.0, 1.3]\n[controller]\nkind = 'learned_ff'\nlearn = false\n";
  const auto steps_of = [&](const std::string& level_m) {
    return read(hot + "[reference]\nkind = 'steps'\nlevels_m = [" + level_m + "]\nhold_s = 99.0\n");
  };
  const Scenario high = steps_of("0.018");
  const auto f = reference_feasibility(high);
  CHECK(f->limited_by == LimitedBy::temperature);
  CHECK(f->held_by == LimitedBy::temperature);
  DOUBLES_EQUAL(0.018, f->max_m, 1e-5);
  const double found = infeasible_ratio_of_run(high);
  printf("found %g, predicted %g\n", found, f->infeasible_ratio);
  DOUBLES_EQUAL(found, f->infeasible_ratio, 0.05);
  STRCMP_CONTAINS(
      "and the muscle does not catch up, when it may be so hot that it gets up to 0.98 W less "
      "power than it needs "
      "(limited_by temperature); it falls behind by up to 5.91 mm; the reference is infeasible for "
      "94.9 % of the "
      "time; the muscle holds 12.1 mm indefinitely (limited_by temperature)",
      described(high).c_str());
  STRCMP_CONTAINS("limited_by temperature)", described(high).c_str());
  // A position that is reported as held is held.
  const Scenario held = steps_of(std::to_string(0.999 * f->held_m));
  DOUBLES_EQUAL(0.0, infeasible_ratio(held), 0.01);
  STRCMP_EQUAL("asks for no more than the muscle can do", described(held).c_str());
  // A sine may exceed it for a short time, or stay below.
  const auto sine_about = [&](const std::string& offset_m) {
    return read(hot + "[reference]\nkind = 'sine'\namplitude_m = 0.005\noffset_m = " + offset_m);
  };
  STRCMP_CONTAINS("because it does not stay at its maximum, 12.3 mm: the muscle holds 12.1 mm",
                  described(sine_about("0.0075")).c_str());
  const auto too_high = reference_feasibility(sine_about("0.009"));
  DOUBLES_EQUAL((f->held_m - 0.009) / 0.005, too_high->feasible_motion_ratio, 1e-3);
  CHECK_TRUE(std::isinf(too_high->feasible_slowing));
}

/// The run ends in the predicted fault at about the predicted time; a shaped reference causes none.
TEST(ReferenceFeasibility, ReportsTheFaultOfASetPointBeyondTheHeldTravel) {
  const auto step_to = [](const std::string& to_m, const std::string& shape) {
    return read("simulation.duration_s = 200.0\nreference = {kind = 'step', to_m = " + to_m +
                ", at_s = 5.0}\ncontroller = {kind = 'learned_ff', shape_reference = " + shape +
                "}\n");
  };
  for (const char* to_m : {"0.030", "0.0255"}) {
    const Scenario scenario = step_to(to_m, "false");
    const auto f = reference_feasibility(scenario);
    Simulation simulation(scenario);
    Summary summary({});
    while (!simulation.done())
      summary.add(simulation.step());
    CHECK(summary.ended_in() == Fault::controller_invalid);
    printf("predicted %g, ended at %g s\n", f->invalid_s, summary.faults().front().time_s);
    DOUBLES_EQUAL(summary.faults().front().time_s, f->invalid_s, 3.0);
    STRCMP_CONTAINS("; it ends in controller_invalid at about ", described(scenario).c_str());
    const Scenario shaped = step_to(to_m, "true");
    CHECK_TRUE(std::isnan(reference_feasibility(shaped)->invalid_s));
    CHECK_FALSE(reference_feasibility(shaped)->feasible());
    STRCMP_CONTAINS("; it is shaped, so that the muscle follows it as far as it can",
                    described(shaped).c_str());
  }
  CHECK_TRUE(std::isnan(reference_feasibility(step_to("0.024", "false"))->invalid_s));
}

TEST(ReferenceFeasibility, ALoadReducesTheHeldTravel) {
  const auto loaded = [](const std::string& to_m, const std::string& load_N) {
    return read("simulation.duration_s = 60.0\nplant.load_N = " + load_N +
                "\nsensor.position.min_m = -0.02\nreference = {kind = 'step', to_m = " + to_m +
                ", at_s = 5.0}\ncontroller = {kind = 'learned_ff', shape_reference = true}\n");
  };
  const double held_m = reference_feasibility(loaded("0.015", "0.0"))->held_m;
  DOUBLES_EQUAL(held_m - 0.1 / 16.0, reference_feasibility(loaded("0.015", "0.1"))->held_m, 1e-6);
  CHECK_TRUE(reference_feasibility(loaded("0.018", "0.1"))->feasible());
  DOUBLES_EQUAL(0.0, infeasible_ratio_of_run(loaded("0.018", "0.1")), 0.0);
  const Scenario beyond = loaded("0.0195", "0.1");
  CHECK_TRUE(reference_feasibility(loaded("0.0195", "0.0"))->feasible());
  CHECK_FALSE(reference_feasibility(beyond)->feasible());
  CHECK_COMPARE(infeasible_ratio_of_run(beyond), >, 0.5);
  DOUBLES_EQUAL(infeasible_ratio_of_run(beyond), infeasible_ratio(beyond), 0.1);
}

/// The error of senses that were never compared depends on the supply voltage that they read.
TEST(ReferenceFeasibility, UsesTheActualSupply) {
  const Scenario scenario = read(
      "simulation.duration_s = 60.0\nsenses.error_ratio = 0.0\n"
      "[reference]\nkind = 'steps'\nlevels_m = [0.010]\nhold_s = 60.0\n");
  const auto f = reference_feasibility(scenario);
  CHECK_COMPARE(f->held_m, <, 0.010);
  DOUBLES_EQUAL(0.0, infeasible_ratio_of_run(scenario), 0.0);
  DOUBLES_EQUAL(0.0, f->infeasible_ratio, 0.01);
}

TEST(ReferenceFeasibility, ReportsWhatAnIdentifiedMuscleCannotProve) {
  Scenario scenario = read(
      "thermal.power_ratio = [0.75, 1.0]\nsensor.position.noise_rms_m = 100e-6\n[reference]\nkind "
      "= 'steps'\nlevels_m = [0.011]\n");
  STRCMP_EQUAL(
      "asks for no more than the muscle can do until it is identified; from then on it holds 6.1 "
      "mm indefinitely (limited_by unproven), not the 11 mm that the reference leads to",
      described(scenario).c_str());
  scenario.known[0].muscle_identified = true;
  CHECK(reference_feasibility(scenario)->limited_by == LimitedBy::unproven);
  const double found = infeasible_ratio_of_run(scenario);
  DOUBLES_EQUAL(found, infeasible_ratio(scenario), 0.05);
  const std::string text = described(scenario);
  STRCMP_CONTAINS("more power than its proof of response allows (limited_by unproven)",
                  text.c_str());
  STRCMP_CONTAINS("; the muscle holds ", text.c_str());
}

TEST(ReferenceFeasibility, TooWeakAMuscleCannotEvenHoldTheMiddle) {
  const std::string weak = "force_per_kelvin_N_per_K = 0.0002\n";
  const std::string text = described(read("[plant]\n" + weak + "[muscle]\n" + weak));
  STRCMP_CONTAINS(
      "first at 0 s, and the muscle does not catch up, when it would have to be heated with up to",
      text.c_str());
  STRCMP_CONTAINS("not even its middle can be held", text.c_str());
}

/// A step of 15 mm through a fast model, held for long.
TEST(ReferenceFeasibility, AnInfeasibleStepStaysInfeasibleInALongRun) {
  const auto step_for = [](const std::string& duration_s, const std::string& shape) {
    return read("simulation.duration_s = " + duration_s + "\ncontroller.kind = 'learned_ff'\n" +
                "controller.shape_reference = " + shape +
                "\nreference = {kind = 'steps', levels_m = [0.015], hold_s = 2000.0}\n"
                "reference_model = {kind = 'poles', poles_rad_per_s = [4.0, 5.0, 6.0]}\n");
  };
  const auto short_run = reference_feasibility(step_for("10.0", "false"));
  const auto long_run = reference_feasibility(step_for("1500.0", "false"));
  CHECK_FALSE(long_run->feasible());
  DOUBLES_EQUAL(short_run->first_duration_s, long_run->first_duration_s, 1e-9);
  DOUBLES_EQUAL(short_run->behind_m, long_run->behind_m, 1e-9);
  DOUBLES_EQUAL(150.0, short_run->infeasible_ratio / long_run->infeasible_ratio, 1e-3);
  CHECK_TRUE(long_run->first_ends);
  STRCMP_CONTAINS(
      "first at 0.065 s for 1.36 s until the muscle has caught up, when it would have to be "
      "heated with up to 2.45 W more than 4.5 W; it falls behind by up to 2.89 mm",
      described(step_for("1500.0", "false")).c_str());
  const InfeasibleTime ran = found_in_run(step_for("100.0", "false"));
  CHECK_TRUE(ran.found());
  DOUBLES_EQUAL(long_run->first_duration_s, ran.first_duration_s(), 0.5);
  // If shaped, the reference waits instead.
  const auto shaped = reference_feasibility(step_for("100.0", "true"));
  const InfeasibleTime shaped_ran = found_in_run(step_for("100.0", "true"));
  CHECK_TRUE(shaped_ran.found());
  DOUBLES_EQUAL(shaped->first_duration_s, shaped_ran.first_duration_s(), 0.1);
}

TEST(ReferenceFeasibility, ReportsHowOftenStepsAreInfeasible) {
  const Scenario steps = read(slow +
                              "[reference]\nkind = 'steps'\nlevels_m = [0.004, 0.016]\n"
                              "hold_s = 30.0\n");
  const auto f = reference_feasibility(steps);
  CHECK(f->limited_by == LimitedBy::maximum);
  // Including the time in which the slow muscle catches up.
  CHECK_COMPARE(f->infeasible_ratio, >, 0.4);
  CHECK_COMPARE(f->infeasible_ratio, <, 0.7);
  DOUBLES_EQUAL(1.0, f->feasible_motion_ratio, 0.0);
}

/// It answers at once for anything that may be written; a run of every tick would take hours.
TEST(ReferenceFeasibility, IsFastForSinesFarApartInFrequency) {
  const auto f = reference_feasibility(
      read("simulation.duration_s = 1e6\n[reference]\nkind = 'multisine'\noffset_m = 0.011\n"
           "amplitudes_m = [0.003, 0.003, 0.003]\n"
           "angular_frequencies_rad_per_s = [1e-4, 1.5, 1e3]\n[controller]\nkind = 'pi'\n"));
  CHECK_TRUE(f.has_value());
  CHECK_COMPARE(f->feasible_motion_ratio, >, 0.0);
}

TEST(ReferenceFeasibility, IsAbsentWithoutAPositionReference) {
  CHECK_FALSE(reference_feasibility(read("operator.action = 'identify'")).has_value());
  CHECK_FALSE(reference_feasibility(read("[joint]")).has_value());
  const std::string open_loop = "controller.kind = 'power'\nreference.kind = 'power'";
  CHECK_FALSE(reference_feasibility(read(open_loop)).has_value());
  STRCMP_EQUAL("", described(read("[joint]")).c_str());
}

TEST(ReferenceFeasibility, ReportsALoadBelowTheSensorsRange) {
  STRCMP_EQUAL("", describe_unseen_rest(read("")).c_str());
  const Scenario loaded = read("plant.load_N = 0.1\n");
  STRCMP_CONTAINS(
      "holds the muscle at -6.25 mm while it is cold, and the sensor reads no less "
      "than 0 mm",
      describe_unseen_rest(loaded).c_str());
  STRCMP_EQUAL(
      "",
      describe_unseen_rest(read("plant.load_N = 0.1\nsensor.position.min_m = -0.01\n")).c_str());
}
