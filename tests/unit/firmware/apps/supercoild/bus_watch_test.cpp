#include "apps/supercoild/bus_watch.hpp"

#include <CppUTest/TestHarness.h>

using namespace supercoil;
using namespace std::chrono_literals;
using Buses = std::vector<linux_board::BusReport>;

TEST_GROUP(BusWatch) {
  daemon::BusWatch watch;
};

TEST(BusWatch, IsSilentAboutABusThatKeepsUp) {
  CHECK(watch.new_warnings({{"i2c-1", 0, 0.0005}}, 0s).empty());
  CHECK(watch.new_warnings({{"i2c-1", 0, 0.0009}}, 100s).empty());
}

TEST(BusWatch, ReportsSkippedRoundsAtOnceAndThenOnceAMinute) {
  const auto first = watch.new_warnings({{"i2c-1", 2, 0.0031}}, 1s);
  LONGS_EQUAL(1, first.size());
  STRCMP_EQUAL(
      "bus i2c-1 is too slow for the loop: 2 rounds left out so far, the longest took 3.1 ms",
      first[0].c_str());
  CHECK(watch.new_warnings({{"i2c-1", 5, 0.0031}}, 60s).empty());
  CHECK(watch.new_warnings({{"i2c-1", 5, 0.0031}}, 61s).size() == 1);
  CHECK(watch.new_warnings({{"i2c-1", 5, 0.0031}}, 200s).empty());
}

TEST(BusWatch, ReportsEachBusSeparately) {
  CHECK(watch.new_warnings({{"i2c-1", 1, 0.002}, {"i2c-3", 0, 0.001}}, 1s).size() == 1);
  const auto second = watch.new_warnings({{"i2c-1", 2, 0.002}, {"i2c-3", 4, 0.002}}, 2s);
  LONGS_EQUAL(1, second.size());
  CHECK(second[0].starts_with("bus i2c-3 "));
}
