#include "apps/supercoil/doctor/readings.hpp"

#include <CppUTest/TestHarness.h>

#include "unit/hal_linux/check/findings.hpp"

using namespace supercoil;
using namespace supercoil::doctor;
using namespace supercoil::test;

TEST_GROUP(DoctorReadings) {
  Readings readings;
  Expected position{"the position's sensor", {1e-6, 0.001}, -0.001, 0.041, "mm", 1e3, true,
                    "look at its wires"};

  void read(std::initializer_list<std::int32_t> counts) {
    for (const std::int32_t value : counts)
      readings.add({value, hal::Time{}, hal::Status::ok}, std::chrono::microseconds(100));
  }
  hal::Finding found(std::optional<hal_linux::CountRange> range = {}) const {
    return assess("channel 1, position", "voltage0 of ads1115", readings, position, range);
  }
};

TEST(DoctorReadings, AreShownInTheirUnit) {
  read({1000, 1010, 990, 1000});
  check_finding("ok", "voltage0 of ads1115: 1.99 to 2.01 mm, noise 0.007071 mm rms, 4 readings", "",
                found());
  LONGS_EQUAL(100'000, readings.mean_time().count());
}

TEST(DoctorReadings, OneOutOfRangeIsEnough) {
  read({990, 1010, 40'100});
  check_finding("problem", "3 readings: must be -1 to 41 mm", "look at its wires", found());
  readings = {};
  read({1000, -2001});
  check_finding("problem", "must be", "look at its wires", found());
}

TEST(DoctorReadings, AFallingSensorHasItsRangeReversed) {
  position.scaling = {-1e-6, 0.040};
  read({0, 41'000});
  check_finding("ok", ": -1 to 40 mm", "", found());
  read({41'001});
  check_finding("problem", "must be", "look at its wires", found());
}

TEST(DoctorReadings, NamesTheRailAtWhichItIsStuck) {
  const hal_linux::CountRange range{-32768, 32767};
  read({32767, 32767, 32767});
  check_finding("problem", "all of them 32767 counts: stuck at the converter's highest rail",
                "at the position's sensor", found(range));
  readings = {};
  read({-32768, -32768});
  check_finding("problem", "stuck at the converter's lowest rail", "wire", found(range));
  // If the converter's range is not known, the reading is merely outside its limits.
  check_finding("problem", "must be", "look at its wires", found());
  readings = {};
  read({32767, 32766});
  check_finding("ok", "33.77 to 33.77 mm", "", found(range));
}

TEST(DoctorReadings, ASensorWithoutNoiseMayBeFrozen) {
  read({1000, 1000, 1000});
  check_finding("warning", "the same 1000 counts each time", "move it by hand", found());
  position.must_move = false;
  check_finding("ok", "noise 0 mm", "", found());
}

TEST(DoctorReadings, AFailureIsAProblem) {
  read({1000, 1010});
  readings.add({0, hal::Time{}, hal::Status::gone}, {});
  check_finding("problem", "1 of 3 readings failed (device gone)", "dmesg", found());
  readings = {};
  readings.add({0, hal::Time{}, hal::Status::busy}, {});
  check_finding("problem", "1 of 1 readings failed (busy)", "dmesg", found());
}
