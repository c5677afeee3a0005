#include "runner/simulation.hpp"

#include <string>
#include <vector>

#include <CppUTest/TestHarness.h>

#include "runner/summary.hpp"
#include "scenario/read_scenario.hpp"

using namespace supercoil;
using namespace supercoil::host_sim;

namespace {

Scenario read(const std::string& text) {
  return parse_scenario(text, "test.toml").value();
}

std::vector<TickRecord> records_of(const Scenario& scenario) {
  Simulation simulation(scenario);
  std::vector<TickRecord> records;
  while (!simulation.done())
    records.push_back(simulation.step());
  return records;
}

double rms_um(const Scenario& scenario, double from_s, double to_s) {
  Summary summary({from_s, to_s});
  Simulation simulation(scenario);
  while (!simulation.done())
    summary.add(simulation.step());
  return summary.tracking().rms() * 1e6;
}

}  // namespace

TEST_GROUP(Simulation){};

TEST(Simulation, RepeatsItselfToTheBit) {
  const Scenario scenario = read("simulation.duration_s = 20.0");
  const auto first = records_of(scenario);
  const auto second = records_of(scenario);
  LONGS_EQUAL(20000, first.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    DOUBLES_EQUAL(first[i].position_m, second[i].position_m, 0.0);
    DOUBLES_EQUAL(first[i].power_W, second[i].power_W, 0.0);
  }
}

TEST(Simulation, DependsOnItsSeed) {
  const auto first = records_of(read("simulation = {duration_s = 5.0, seed = 1}"));
  const auto second = records_of(read("simulation = {duration_s = 5.0, seed = 2}"));
  CHECK(first.back().measured_m != second.back().measured_m);
}

TEST(Simulation, GivesNoPowerOutsideTheLimits) {
  for (const TickRecord& r : records_of(read("simulation.duration_s = 60.0\npower.max_W = 3.0"))) {
    CHECK(r.applied_power_W >= 0.0 && r.applied_power_W <= 3.0);
    CHECK_EQUAL(r.limited, r.applied_power_W != r.power_W);
  }
}

TEST(Simulation, AppliesAnEventAtItsTickAndNotBefore) {
  const Scenario scenario = read(R"(
simulation.duration_s = 2.0
reference = {kind = "power", offset_W = 2.0, amplitudes_W = [0.0], angular_frequencies_rad_per_s = [1.0]}
controller.kind = "power"
[[event]]
at_s = 1.0
reference = {kind = "power", offset_W = 3.0, amplitudes_W = [0.0], angular_frequencies_rad_per_s = [1.0]}
)");
  const auto records = records_of(scenario);
  DOUBLES_EQUAL(2.0, records[999].applied_power_W, 0.0);
  DOUBLES_EQUAL(3.0, records[1000].applied_power_W, 0.0);
}

TEST(Simulation, ChangesTheTrueMuscleUnderTheController) {
  Scenario scenario = read(
      "simulation.duration_s = 40.0\ncontroller.kind = 'pi'\n"
      "[[event]]\nat_s = 20.0\nplant.stiffness_N_per_m = 12.0\n");
  Simulation simulation(scenario);
  while (!simulation.done())
    simulation.step();
  DOUBLES_EQUAL(12.0, simulation.plant().parameters().stiffness_N_per_m, 0.0);
}

TEST(Simulation, EstimatorFindsTheMuscleThatTheBoardBelievesOtherwise) {
  const Scenario scenario = read(R"(
simulation.duration_s = 200.0
power.max_W = 5.0
reference.kind = "power"
controller.kind = "power"
sensor.position = {noise_rms_m = 0.0, resolution_bits = 0}
)");
  Simulation simulation(scenario);
  while (!simulation.done())
    simulation.step();
  const auto estimate = simulation.estimate();
  CHECK(estimate.has_value());
  CHECK(estimate->trusted);
  DOUBLES_EQUAL(38.606, estimate->theta[1], 0.4);
  DOUBLES_EQUAL(322.09, estimate->theta[2], 3.2);
  DOUBLES_EQUAL(165.58, estimate->theta[3], 1.7);
}

TEST(Simulation, PiTracksAsTheTrialDid) {
  // docs/paper.md: 225 µm before the change, on another implementation.
  const Scenario scenario = read("simulation.duration_s = 100.0\ncontroller.kind = 'pi'");
  DOUBLES_EQUAL(225.0, rms_um(scenario, 60.0, 100.0), 5.0);
}

TEST(Simulation, MracPresetATracksTenTimesBetterThanPi) {
  const Scenario scenario = read("simulation.duration_s = 100.0\ncontroller.preset = 'a'");
  CHECK_COMPARE(rms_um(scenario, 60.0, 100.0), <, 15.0);
}
