#include "supervisor/fault.hpp"

#include <set>
#include <string>

#include <CppUTest/TestHarness.h>

using namespace supercoil;

TEST_GROUP(Faults){};

TEST(Faults, HaveNumbersThatNeverChange) {
  // Logs and CAN refer to these: a number may be added, none may change.
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
