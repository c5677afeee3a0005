#include "apps/supercoild/rounds.hpp"

#include <vector>

#include <CppUTest/TestHarness.h>

using namespace supercoil;
using namespace std::chrono_literals;

namespace {

/// When rounds begin that take this long each.
std::vector<hal::Time> begins(const std::vector<hal::Duration>& takes) {
  daemon::Rounds rounds(0ns);
  std::vector<hal::Time> all;
  hal::Time now{0};
  for (const hal::Duration taken : takes) {
    now += rounds.wait(now);
    all.push_back(now);
    now += taken;
  }
  return all;
}

}  // namespace

TEST_GROUP(Rounds){};

/// The same number of rounds sees each tick of 10 ms.
TEST(Rounds, StartOnAGridIndependentOfTheirDuration) {
  CHECK((begins({0ms, 2700us, 4ms, 100us, 0ms}) ==
         std::vector<hal::Time>{5ms, 10ms, 15ms, 20ms, 25ms}));
}

TEST(Rounds, AnOverlongRoundIsFollowedByAPauseAndNotCaughtUp) {
  CHECK((begins({7ms, 0ms}) == std::vector<hal::Time>{5ms, 13ms}));
  CHECK((begins({500ms, 0ms, 0ms}) == std::vector<hal::Time>{5ms, 506ms, 511ms}));
}

TEST(Rounds, AWaitThatEndsEarlyIsResumed) {
  daemon::Rounds rounds(0ns);
  CHECK(rounds.wait(0ms) == 5ms);
  CHECK(rounds.wait(2ms) == 3ms);
  CHECK(rounds.wait(5ms) == 5ms);
}
