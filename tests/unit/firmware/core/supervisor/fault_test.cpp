#include "supervisor/fault.hpp"

#include <set>
#include <string>

#include <CppUTest/TestHarness.h>

using namespace supercoil;

TEST_GROUP(Faults){};

TEST(Faults, HaveNumbersThatNeverChange) {
  // Logs and CAN use these numbers: numbers may be added, but none may change.
  LONGS_EQUAL(10, static_cast<int>(Fault::sensor_out_of_range));
  LONGS_EQUAL(24, static_cast<int>(Fault::duty_wrong));
  LONGS_EQUAL(33, static_cast<int>(Fault::resistance_drift));
  LONGS_EQUAL(42, static_cast<int>(Fault::power_limit_exceeded));
  LONGS_EQUAL(52, static_cast<int>(Fault::telemetry_dead));
  LONGS_EQUAL(63, static_cast<int>(Fault::emergency_stop));
  LONGS_EQUAL(71, static_cast<int>(Fault::bus_error_passive));
  LONGS_EQUAL(72, static_cast<int>(Fault::node_conflict));
  LONGS_EQUAL(82, static_cast<int>(Fault::self_test_failed));
}

TEST(Faults, AreAllDescribedOnceAndInOrder) {
  std::set<std::string_view> names;
  int last = 0;
  for (const FaultInfo& fault : all_faults()) {
    CHECK(static_cast<int>(fault.fault) > last);
    last = static_cast<int>(fault.fault);
    CHECK(names.insert(fault.name).second);
    CHECK(fault.meaning.size() > 10);
    CHECK(info(fault.fault)->name == fault.name);
  }
}

TEST(Faults, NoneAndUnknownNumbersHaveNoDescription) {
  CHECK_FALSE(info(Fault::none).has_value());
  CHECK_FALSE(info(static_cast<Fault>(99)).has_value());
  CHECK(name(Fault::none) == "none");
}

TEST(Faults, KeepTheirOriginalNumbers) {
  struct Numbered {
    Fault fault;
    int number;
  };
  for (const auto& [fault, number] : {Numbered{Fault::none, 0},
                                      {Fault::sensor_out_of_range, 10},
                                      {Fault::sensor_stale, 11},
                                      {Fault::sensor_frozen, 12},
                                      {Fault::sensor_jump, 13},
                                      {Fault::sensors_disagree, 14},
                                      {Fault::heater_open, 20},
                                      {Fault::heater_short, 21},
                                      {Fault::heater_stuck_on, 22},
                                      {Fault::heater_not_responding, 23},
                                      {Fault::duty_wrong, 24},
                                      {Fault::line_failed, 25},
                                      {Fault::over_temperature, 30},
                                      {Fault::over_travel, 31},
                                      {Fault::energy_budget_exceeded, 32},
                                      {Fault::resistance_drift, 33},
                                      {Fault::muscle_loose, 34},
                                      {Fault::under_voltage, 40},
                                      {Fault::over_voltage, 41},
                                      {Fault::power_limit_exceeded, 42},
                                      {Fault::overrun, 50},
                                      {Fault::tick_late, 51},
                                      {Fault::telemetry_dead, 52},
                                      {Fault::command_timeout, 60},
                                      {Fault::command_damaged, 61},
                                      {Fault::command_not_allowed, 62},
                                      {Fault::emergency_stop, 63},
                                      {Fault::bus_off, 70},
                                      {Fault::bus_error_passive, 71},
                                      {Fault::node_conflict, 72},
                                      {Fault::configuration_invalid, 80},
                                      {Fault::controller_invalid, 81},
                                      {Fault::self_test_failed, 82}}) {
    LONGS_EQUAL(number, static_cast<int>(fault));
    CHECK_EQUAL(number != 0, info(fault).has_value());
  }
}
