#include "loop/stage_times.hpp"

#include <numeric>

#include <CppUTest/TestHarness.h>

using namespace supercoil;
using namespace std::chrono_literals;

TEST_GROUP(StageTimes){};

TEST(StageTimes, KeepLastMeanAndLargest) {
  StageTime time;
  DOUBLES_EQUAL(0.0, time.mean_ns(), 0.0);
  for (const auto taken : {100ns, 300ns, 200ns})
    time.add(taken);
  CHECK(time.last() == 200ns);
  CHECK(time.largest() == 300ns);
  DOUBLES_EQUAL(200.0, time.mean_ns(), 1e-12);
}

TEST(StageTimes, CountEachTimeInOneBinOfItsPowerOfTwo) {
  StageTime time;
  time.add(0ns);
  time.add(1ns);
  time.add(127ns);
  time.add(128ns);
  time.add(1h);
  time.add(-5ns);  // a clock that went back counts as no time
  LONGS_EQUAL(2, time.histogram()[0]);
  LONGS_EQUAL(1, time.histogram()[1]);
  LONGS_EQUAL(1, time.histogram()[7]);
  LONGS_EQUAL(1, time.histogram()[8]);
  LONGS_EQUAL(1, time.histogram()[31]);
  LONGS_EQUAL(6,
              std::accumulate(time.histogram().begin(), time.histogram().end(), std::uint64_t{0}));
}
