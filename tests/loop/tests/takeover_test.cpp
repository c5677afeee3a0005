// Switching controllers while hot.
#include <cmath>

#include <CppUTest/TestHarness.h>

#include "loop/support/situations.hpp"

using namespace supercoil;
using namespace supercoil::test;

namespace {

constexpr double noise_rms_m = 10e-6;

/// How far the muscle is, within a time after a switch, from where it would have been without.
double moved_m(int from, int to, bool sine, int ticks) {
  const auto prepared = [&](Rig& rig) {
    rig.boot();
    rig.arm();
    rig.run(0.2);
    rig.send(Verb::controller, from);
    rig.heat(Task::position);
    if (!sine) rig.task = Task::nothing;
    const double end_s = rig.time_s() + 40.0;
    while (rig.time_s() < end_s) {
      if (!sine) rig.send(Verb::position, 0.010);
      rig.tick();
    }
  };
  Rig stays(rough_board());
  Rig switches(rough_board());
  prepared(stays);
  prepared(switches);
  switches.send(Verb::controller, to);
  double furthest_m = 0.0;
  for (int i = 0; i < ticks; ++i) {
    if (!sine) stays.send(Verb::position, 0.010);
    if (!sine) switches.send(Verb::position, 0.010);
    stays.tick();
    switches.tick();
    furthest_m = std::fmax(furthest_m, std::abs(switches.muscle().plant().position_m() -
                                                stays.muscle().plant().position_m()));
  }
  CHECK(switches.state() == State::active);
  return furthest_m;
}

}  // namespace

TEST_GROUP(Takeover){};

TEST(Takeover, AtRestMovesTheMuscleByLessThanTheNoise) {
  for (int from = 0; from < 3; ++from) {
    for (int to = 0; to < 3; ++to) {
      const double moved = moved_m(from, to, false, 1000);
      if (from != to) printf("%d -> %d at rest: %.2f um\n", from, to, moved * 1e6);
      CHECK_COMPARE(moved, <, noise_rms_m);
    }
  }
}

/// Later it goes where the other controller leads it: their errors in motion differ by 200 µm.
TEST(Takeover, InMotionDoesNotJerkTheMuscle) {
  for (int from = 0; from < 3; ++from) {
    for (int to = 0; to < 3; ++to) {
      const double moved = moved_m(from, to, true, 100);
      if (from != to) printf("%d -> %d in motion: %.2f um\n", from, to, moved * 1e6);
      CHECK_COMPARE(moved, <, noise_rms_m);
    }
  }
}
