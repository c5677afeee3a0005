// Whether a reference can be followed, told before it is run.
#include "runner/reference_feasibility.hpp"

#include <cstdio>
#include <string>

#include <CppUTest/TestHarness.h>

#include "runner/summary.hpp"
#include "unit/host_sim/support/scenarios.hpp"

using namespace supercoil;
using namespace supercoil::host_sim;
using supercoil::test::read;

namespace {

/// Its heat follows a power within 22 s, and the reference wants it in 4 s.
const std::string slow =
    "simulation.duration_s = 120.0\n[plant]\nthermal_mass_J_per_K = 2.0\n"
    "[muscle]\nthermal_mass_J_per_K = 2.0\n[controller]\nkind = 'learned_ff'\n";

double infeasible_ratio(const Scenario& scenario) {
  return reference_feasibility(scenario)->infeasible_ratio;
}

}  // namespace

TEST_GROUP(ReferenceFeasibility){};

TEST(ReferenceFeasibility, TheDefaultsAreFeasible) {
  const auto f = reference_feasibility(read(""));
  CHECK_TRUE(f.has_value());
  DOUBLES_EQUAL(0.0, f->infeasible_ratio, 0.001);
  DOUBLES_EQUAL(1.0, f->feasible_motion_ratio, 0.0);
  STRCMP_EQUAL("", describe_reference(read(""), true).c_str());
  STRCMP_CONTAINS("no more than", describe_reference(read(""), false).c_str());
}

TEST(ReferenceFeasibility, ASlowMusclesSineIsFeasibleAsItSays) {
  Scenario scenario = read(slow);
  const auto f = reference_feasibility(scenario);
  CHECK_COMPARE(f->infeasible_ratio, >, 0.5);
  CHECK_COMPARE(f->feasible_motion_ratio, <, 0.5);
  CHECK_COMPARE(f->feasible_slowing, >, 3.0);
  CHECK_COMPARE(f->feasible_slowing, <, 20.0);
  const Reference asked = scenario.start.reference;
  const auto with = [&](double amplitude_ratio, double slowing) {
    scenario.duration_s = 2000.0;
    scenario.start.reference = asked;
    scenario.start.reference.terms[0].amplitude *= amplitude_ratio;
    scenario.start.reference.terms[0].angular_frequency_rad_per_s /= slowing;
    return infeasible_ratio(scenario);
  };
  // What is left is the way from rest to the middle.
  const double coming_up = 0.01;
  CHECK_COMPARE(with(0.99 * f->feasible_motion_ratio, 1.0), <, coming_up);
  CHECK_COMPARE(with(1.05 * f->feasible_motion_ratio, 1.0), >, 5.0 * coming_up);
  CHECK_COMPARE(with(1.0, f->feasible_slowing), <, coming_up);
  CHECK_COMPARE(with(1.0, 0.9 * f->feasible_slowing), >, 2.0 * coming_up);
  const std::string told = describe_reference(read(slow), true);
  STRCMP_CONTAINS(
      "0.224 of its motion about the middle is feasible, or all of it 7.99 times as slow",
      told.c_str());
  STRCMP_CONTAINS("with shape_reference = true", told.c_str());
  const Scenario shaped = read(slow + "shape_reference = true\n");
  STRCMP_CONTAINS("; it is shaped", describe_reference(shaped, true).c_str());
}

/// As its controller counts it, where that goes by the same muscle.
TEST(ReferenceFeasibility, AgreesWithWhatARunFinds) {
  const Scenario scenario = read(
      "simulation.duration_s = 100.0\nplant.thermal_mass_J_per_K = 0.5\n"
      "muscle.thermal_mass_J_per_K = 0.5\nreference.angular_frequency_rad_per_s = 0.5\n"
      "[controller]\nkind = 'learned_ff'\nlearn = false\nshape_reference = true\n");
  Simulation simulation(scenario);
  Summary summary({});
  while (!simulation.done())
    summary.add(simulation.step());
  printf("found %g, told %g\n", summary.infeasible_ratio(), infeasible_ratio(scenario));
  CHECK_COMPARE(summary.infeasible_ratio(), >, 0.05);
  CHECK_COMPARE(infeasible_ratio(scenario), >, 0.5 * summary.infeasible_ratio());
  CHECK_COMPARE(infeasible_ratio(scenario), <, 1.5 * summary.infeasible_ratio());
}

TEST(ReferenceFeasibility, AMuscleThatIsTooWeakCannotEvenHoldTheMiddle) {
  const std::string weak = "force_per_kelvin_N_per_K = 0.0002\n";
  const std::string told = describe_reference(read("[plant]\n" + weak + "[muscle]\n" + weak), true);
  STRCMP_CONTAINS("first at 0 s, when it would have to be heated with more than 4.5 W",
                  told.c_str());
  STRCMP_CONTAINS("not even its middle can be held", told.c_str());
}

TEST(ReferenceFeasibility, OfStepsItTellsHowOften) {
  const Scenario steps = read(slow +
                              "[reference]\nkind = 'steps'\nlevels_m = [0.004, 0.016]\n"
                              "hold_s = 30.0\n");
  const auto f = reference_feasibility(steps);
  CHECK(f->first == control::Infeasible::heating);
  CHECK_COMPARE(f->infeasible_ratio, >, 0.02);
  CHECK_COMPARE(f->infeasible_ratio, <, 0.3);
  DOUBLES_EQUAL(1.0, f->feasible_motion_ratio, 0.0);
}

/// What may be written is told at once: in a run of every tick this would take hours.
TEST(ReferenceFeasibility, OfSinesThatAreFarApartItTellsAsSoon) {
  const auto f = reference_feasibility(
      read("simulation.duration_s = 1e6\n[reference]\nkind = 'multisine'\noffset_m = 0.011\n"
           "amplitudes_m = [0.003, 0.003, 0.003]\n"
           "angular_frequencies_rad_per_s = [1e-4, 1.5, 1e3]\n[controller]\nkind = 'pi'\n"));
  CHECK_TRUE(f.has_value());
  CHECK_COMPARE(f->feasible_motion_ratio, >, 0.0);
}

TEST(ReferenceFeasibility, WithoutAPositionToFollowThereIsNone) {
  CHECK_FALSE(reference_feasibility(read("operator.action = 'identify'")).has_value());
  CHECK_FALSE(reference_feasibility(read("[joint]")).has_value());
  const std::string open_loop = "controller.kind = 'power'\nreference.kind = 'power'";
  CHECK_FALSE(reference_feasibility(read(open_loop)).has_value());
  STRCMP_EQUAL("", describe_reference(read("[joint]"), false).c_str());
}

TEST(ReferenceFeasibility, ALoadBelowTheSensorsRangeIsTold) {
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
