// Sensors like those in laboratories.
#include <algorithm>
#include <cmath>
#include <set>

#include <CppUTest/TestHarness.h>

#include "runner/simulation.hpp"
#include "simulated_board/converter.hpp"
#include "simulated_board/thermometer.hpp"
#include "unit/host_sim/support/scenarios.hpp"

using namespace supercoil;
using namespace supercoil::host_sim;
using supercoil::test::read;

TEST_GROUP(Sensors){};

TEST(Sensors, ThermometerHasItsLagAndOffset) {
  Thermometer thermometer(ThermometerReading{2.0, 1.5, 0.0, 0.1}, 20.0, 1);
  CHECK(std::isnan(thermometer.reading_C()));
  for (int tick = 0; tick < 2000; ++tick)
    thermometer.step(70.0, 1e-3);
  DOUBLES_EQUAL(70.0 - 50.0 * std::exp(-1.0) + 1.5, thermometer.reading_C(), 50.0 * 0.1 / 2.0);
  for (int tick = 0; tick < 60000; ++tick)
    thermometer.step(70.0, 1e-3);
  DOUBLES_EQUAL(71.5, thermometer.reading_C(), 1e-9);
}

TEST(Sensors, ThermometerReadsAtItsRate) {
  Thermometer thermometer(ThermometerReading{0.0, 0.0, 0.0, 0.1}, 20.0, 1);
  std::set<double> readings;
  for (int tick = 0; tick < 1000; ++tick) {
    thermometer.step(20.0 + tick, 1e-3);
    readings.insert(thermometer.reading_C());
  }
  LONGS_EQUAL(10, readings.size());
}

TEST(Sensors, ThermometersNoiseIsAsConfigured) {
  Thermometer thermometer(ThermometerReading{0.0, 0.0, 0.5, 1e-3}, 20.0, 1);
  double squares = 0.0;
  for (int tick = 0; tick < 20000; ++tick) {
    thermometer.step(20.0, 1e-3);
    squares += std::pow(thermometer.reading_C() - 20.0, 2);
  }
  DOUBLES_EQUAL(0.5, std::sqrt(squares / 20000.0), 0.02);
}

TEST(Sensors, ThermometerIsInTheRecordOnlyIfPresent) {
  const Scenario without = read("simulation.duration_s = 0.01");
  CHECK(std::isnan(Simulation(without).step().thermometer_C));
  const Scenario with = read("simulation.duration_s = 0.01\nsensor.temperature.offset_K = 3.0");
  DOUBLES_EQUAL(28.0, Simulation(with).step().thermometer_C, 0.5);
}

TEST(Sensors, ASingleStrokeIsMeasured) {
  const Scenario s = read(
      "simulation.duration_s = 40.0\nplant.lonely_stroke_m = 0.005\n"
      "[[event]]\nat_s = 20.0\noperator.action = 'rest'\n");
  Simulation simulation(s);
  TickRecord record;
  while (!simulation.done())
    record = simulation.step();
  CHECK(record.fault == Fault::none);
  CHECK_COMPARE(record.position_m, <, -0.001);
  DOUBLES_EQUAL(record.position_m, record.measured_m, 1e-4);
}

TEST(Sensors, CoarseCountsAreUpdatedAtTheirRate) {
  const Scenario s =
      read("simulation.duration_s = 20.0\n[sensor.position]\ncount_m = 20e-6\nrate_Hz = 100.0\n");
  Simulation simulation(s);
  int changes = 0;
  double last_m = 0.0;
  while (!simulation.done()) {
    const TickRecord record = simulation.step();
    CHECK(record.fault == Fault::none);
    const double counts = record.measured_m / 20e-6;
    DOUBLES_EQUAL(std::nearbyint(counts), counts, 1e-6);
    changes += record.measured_m != last_m ? 1 : 0;
    last_m = record.measured_m;
  }
  CHECK_COMPARE(changes, >, 500);
  CHECK_COMPARE(changes, <=, 2001);
}

TEST(Sensors, ConversionsKeepARateThatDoesNotDivideTheTicks) {
  const auto conversions_in_1_s = [](double rate_Hz) {
    SimulatedConverter converter(ConverterSettings{.period_s = 1.0 / rate_Hz}, 1);
    std::set<std::int32_t> counts;
    for (int tick = 0; tick < 1000; ++tick) {
      converter.offer(1e-3 * tick, hal::Time{} + tick * hal::duration_from(1e-3));
      counts.insert(converter.latest().counts);
    }
    return static_cast<int>(counts.size());
  };
  LONGS_EQUAL(100, conversions_in_1_s(100.0));
  LONGS_EQUAL(300, conversions_in_1_s(300.0));
  LONGS_EQUAL(700, conversions_in_1_s(700.0));
  LONGS_EQUAL(1000, conversions_in_1_s(3000.0));
}
