#include <string>

#include <CppUTest/TestHarness.h>

#include "scenario/read_scenario.hpp"
#include "unit/host_sim/support/scenarios.hpp"

using namespace supercoil;
using namespace supercoil::host_sim;
using supercoil::test::problems;
using supercoil::test::read;

TEST_GROUP(Events){};

TEST(Events, ChangeOnlyTheirKeys) {
  const Scenario s = read(R"(
[plant]
damping_Ns_per_m = 3.0
[[event]]
at_s = 100.0
plant.stiffness_N_per_m = 12.0
sensor.position.noise_rms_m = 1e-4
)");
  LONGS_EQUAL(1, s.events.size());
  const Event& event = s.events[0];
  DOUBLES_EQUAL(100.0, event.at_s, 0.0);
  DOUBLES_EQUAL(12.0, event.conditions.plant.parameters.stiffness_N_per_m, 0.0);
  DOUBLES_EQUAL(3.0, event.conditions.plant.parameters.damping_Ns_per_m, 0.0);
  DOUBLES_EQUAL(1e-4, event.conditions.position_sensor.noise_rms_m, 0.0);
  DOUBLES_EQUAL(16.0, s.start.plant.parameters.stiffness_N_per_m, 0.0);
}

TEST(Events, AccumulateInTheOrderOfTheirTimes) {
  const Scenario s = read(R"(
[[event]]
at_s = 50.0
plant.stiffness_N_per_m = 10.0
[[event]]
at_s = 20.0
plant.stiffness_N_per_m = 14.0
plant.damping_Ns_per_m = 1.0
)");
  DOUBLES_EQUAL(20.0, s.events[0].at_s, 0.0);
  DOUBLES_EQUAL(14.0, s.events[0].conditions.plant.parameters.stiffness_N_per_m, 0.0);
  DOUBLES_EQUAL(10.0, s.events[1].conditions.plant.parameters.stiffness_N_per_m, 0.0);
  DOUBLES_EQUAL(1.0, s.events[1].conditions.plant.parameters.damping_Ns_per_m, 0.0);
}

TEST(Events, DoNotChangeTheBoardsModelOfTheMuscle) {
  const Scenario s = read("[[event]]\nat_s = 1.0\nplant.stiffness_N_per_m = 8.0\n");
  DOUBLES_EQUAL(s.start.controller.dc_gain_m_per_W,
                s.events[0].conditions.controller.dc_gain_m_per_W, 0.0);
  CHECK_FALSE(s.events[0].new_controller);
}

TEST(Events, CanChangeTheControllerForOneWithOtherKeys) {
  const Scenario s = read(R"(
[controller]
kind = "mrac"
preset = "printed"
[[event]]
at_s = 10.0
controller.kind = "pi"
controller.integral_W_per_m_s = 500.0
)");
  CHECK(s.events[0].new_controller);
  CHECK(s.events[0].conditions.controller.kind == control::ControllerKind::pi);
  DOUBLES_EQUAL(500.0, s.events[0].conditions.controller.pi.integral_W_per_m_s, 0.0);
}

TEST(Events, WrongKeyIsReportedOnItsOwnLine) {
  STRCMP_EQUAL(
      "s.toml:3: plant.stifness_N_per_m = 12: is not a key of [plant]; did you mean "
      "stiffness_N_per_m?\n",
      problems("[[event]]\nat_s = 3.0\nplant.stifness_N_per_m = 12.0\n").c_str());
}

TEST(Events, WithoutATimeAreRefused) {
  STRCMP_EQUAL("s.toml:2: event.at_s: is missing: give the time of the event\n",
               problems("\n[[event]]\nplant.stiffness_N_per_m = 12.0\n").c_str());
}

TEST(Events, AfterTheEndAreRefused) {
  STRCMP_EQUAL("s.toml:4: event.at_s = 11: must be 0 to 10\n",
               problems("[simulation]\nduration_s = 10.0\n[[event]]\nat_s = 11.0\n").c_str());
}

TEST(Events, AtTheEndAreRefused) {
  STRCMP_EQUAL("s.toml:4: event.at_s = 10: must be before the end of the run, duration_s\n",
               problems("[simulation]\nduration_s = 10.0\n[[event]]\nat_s = 10.0\n").c_str());
}

TEST(Events, MayBeAnEmptyList) {
  LONGS_EQUAL(0, read("event = []\n").events.size());
}

TEST(Events, CannotChangeTheSimulationItself) {
  STRCMP_EQUAL("s.toml:3: event.simulation: cannot change during a run\n",
               problems("[[event]]\nat_s = 1.0\nsimulation.seed = 2\n").c_str());
}

TEST(Events, InsideAnEventAreRefused) {
  STRCMP_EQUAL("s.toml:3: event.event: cannot change during a run\n",
               problems("[[event]]\nat_s = 1.0\nevent = 3\n").c_str());
  STRCMP_EQUAL("s.toml:3: event.event: cannot change during a run\n",
               problems("[[event]]\nat_s = 1.0\n[[event.event]]\nat_s = 2.0\n").c_str());
}

TEST(Events, AtTheSameTimeAreOneChange) {
  const Scenario s = read(R"(
[[event]]
at_s = 1.0
reference.kind = "power"
[[event]]
at_s = 1.0
controller.kind = "power"
)");
  LONGS_EQUAL(1, s.events.size());
  CHECK(s.events[0].conditions.reference.kind == ReferenceKind::power);
  CHECK(s.events[0].conditions.controller.kind == control::ControllerKind::power);
}
