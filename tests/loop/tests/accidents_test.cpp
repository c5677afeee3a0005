// Accidents that other heaters had. Each must end cold.
#include <string>

#include <CppUTest/TestHarness.h>

#include "runner/simulation.hpp"
#include "scenario/read_scenario.hpp"

using namespace supercoil;
using namespace supercoil::host_sim;

namespace {

struct Aftermath {
  double hottest_K = 0.0;  ///< above the air
  double last_K = 0.0;
  double last_W = 0.0;
  Fault fault = Fault::none;
  double fault_s = 0.0;
};

Aftermath aftermath_of(const std::string& text) {
  const auto scenario = parse_scenario(text, "accident.toml");
  if (!scenario) FAIL(config::to_text(scenario.error()).c_str());
  Simulation simulation(*scenario);
  Aftermath after;
  while (!simulation.done()) {
    const TickRecord r = simulation.step();
    if (after.fault == Fault::none) after.fault_s = r.time_s;
    after.fault = r.fault;
    after.last_K = r.temperature_rise_K;
    after.last_W = r.applied_power_W;
  }
  after.hottest_K = simulation.plant().peak_temperature_rise_K();
  return after;
}

void check_cold(const Aftermath& after, Fault fault) {
  STRCMP_EQUAL(std::string(name(fault)).c_str(), std::string(name(after.fault)).c_str());
  DOUBLES_EQUAL(0.0, after.last_W, 0.0);
  CHECK_COMPARE(after.last_K, <, 1.0);
  CHECK_COMPARE(after.hottest_K, <, 60.0);
}

std::string constant(const std::string& position_m) {
  return "{kind = 'step', to_m = " + position_m + "}\n";
}

}  // namespace

TEST_GROUP(Accidents){};

TEST(Accidents, SensorWireComesOffAtFullPower) {
  const Aftermath by_power = aftermath_of(
      "simulation.duration_s = 60.0\ncontroller.kind = 'power'\n"
      "reference = {kind = 'power', offset_W = 4.5, amplitudes_W = [0.0], "
      "angular_frequencies_rad_per_s = [1.0]}\n"
      "[[event]]\nat_s = 20.0\ninjected_fault.position_loose = true\n");
  check_cold(by_power, Fault::sensor_out_of_range);
  DOUBLES_EQUAL(20.005, by_power.fault_s, 0.005);
  // A set point that it never reaches: full power as well.
  const Aftermath by_position = aftermath_of(
      "simulation.duration_s = 60.0\ncontroller.kind = 'pi'\nreference = " + constant("0.030") +
      "[[event]]\nat_s = 20.0\ninjected_fault.position_loose = true\n");
  check_cold(by_position, Fault::sensor_out_of_range);
  DOUBLES_EQUAL(20.005, by_position.fault_s, 0.005);
}

TEST(Accidents, OneOfThreeParallelThreadsBreaksAndOverloadsTheOthers) {
  // Each gets a third of the power that is measured; once one breaks, the two left get a half each.
  for (const char* controller : {"kind = 'pi'", "kind = 'learned_ff'"}) {
    const Aftermath after =
        aftermath_of(std::string("simulation.duration_s = 60.0\nreference = ") + constant("0.020") +
                     "[controller]\n" + controller +
                     "\n[[event]]\nat_s = 20.0\nplant.resistance_Ohm = 15.0\npower.gain = 1.5\n");
    check_cold(after, Fault::resistance_drift);
    DOUBLES_EQUAL(20.8, after.fault_s, 0.3);
  }
}

TEST(Accidents, DetachedSensorReadsFourKelvinLowForever) {
  // The muscle moves by 0.54 mm per kelvin. At 1 K the sensor comes off and stays there; then 5 K
  // are asked for, which it will never show.
  for (const char* controller : {"pi", "mrac"}) {
    const Aftermath after =
        aftermath_of("simulation.duration_s = 90.0\ncontroller.kind = '" + std::string(controller) +
                     "'\nreference = " + constant("0.00054") +
                     "[[event]]\nat_s = 20.0\ninjected_fault.muscle_slack = true\n"
                     "reference = " +
                     constant("0.00269"));
    check_cold(after, Fault::heater_not_responding);
    CHECK_COMPARE(after.fault_s, <, 60.0);
  }
}
