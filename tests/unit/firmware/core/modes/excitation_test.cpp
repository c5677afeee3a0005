#include "modes/excitation.hpp"

#include <algorithm>
#include <vector>

#include <CppUTest/TestHarness.h>

using namespace supercoil;
using modes::Excitation;

namespace {

constexpr double tick_s = 0.01;
constexpr double thermal_s = 10.0;
constexpr double max_travel_m = 0.02;

struct Strokes {
  std::vector<double> lowest_m;  ///< of each cycle but the last, which ends while cooling
  std::vector<double> ended_m;   ///< where each cycle ended
  double took_s = 0.0;
};

/// A muscle that full power would move to this multiple of the channel's travel.
Strokes strokes_of(double overpowered, bool goes_on = false, double cooling_s = thermal_s) {
  constexpr double max_W = 4.0;
  Excitation excitation({max_travel_m, tick_s});
  excitation.start(0.0);
  Strokes all;
  double position_m = 0.0;
  double lowest_m = max_travel_m;
  std::size_t cycle = 0;
  while (!excitation.done() && all.took_s < 3000.0) {
    const double power_W = excitation.step(position_m, max_W);
    const double steady_m = overpowered * max_travel_m * power_W / max_W;
    position_m += tick_s / cooling_s * (steady_m - position_m);
    all.took_s += tick_s;
    lowest_m = std::min(lowest_m, position_m);
    if (excitation.cycle() == cycle) continue;
    cycle = excitation.cycle();
    if (goes_on && excitation.done() && cycle == Excitation::cycles) {
      DOUBLES_EQUAL(1.0, excitation.progress(), 1e-6);
      CHECK(excitation.go_on());
      DOUBLES_EQUAL(0.0, excitation.progress(), 1e-6);
    }
    all.lowest_m.push_back(lowest_m);
    all.ended_m.push_back(position_m);
    lowest_m = max_travel_m;
  }
  if (goes_on) CHECK_FALSE(excitation.go_on());
  return all;
}

struct FirstShorterStroke {
  double began_m = 0.0;
  double lowest_m = 0.0;  ///< before it reached its highest position
  double highest_m = 0.0;
};

FirstShorterStroke first_shorter_stroke() {
  Excitation excitation({max_travel_m, tick_s});
  excitation.start(0.0);
  double position_m = 0.0;
  const auto step = [&] {
    const double steady_m = max_travel_m * excitation.step(position_m, 4.0);
    position_m += tick_s / thermal_s * (steady_m - position_m);
  };
  while (!excitation.done())
    step();
  excitation.start_shorter();
  FirstShorterStroke stroke{position_m, position_m, position_m};
  while (excitation.cycle() == 0) {
    step();
    if (position_m > stroke.highest_m) {
      stroke.highest_m = position_m;
    } else if (stroke.highest_m == stroke.began_m) {
      stroke.lowest_m = std::min(stroke.lowest_m, position_m);
    }
  }
  return stroke;
}

/// The lows of the first six cycles, as a fraction of the reach.
std::vector<double> lows_of_slow_muscle_with_play() {
  constexpr double cooling_s = 40.0, play_m = 0.001, max_W = 4.0;
  Excitation excitation({max_travel_m, tick_s});
  excitation.start(0.0);
  double stretch_m = 0.0, position_m = 0.0;
  std::vector<double> lows{1.0};
  while (!excitation.done() && lows.size() <= 6) {
    const std::size_t cycle = excitation.cycle();
    const double steady_m = 2.0 * max_travel_m * excitation.step(position_m, max_W) / max_W;
    stretch_m += tick_s / cooling_s * (steady_m - stretch_m);
    position_m = std::clamp(position_m, stretch_m - play_m, stretch_m + play_m);
    lows.back() = std::min(lows.back(), position_m / (0.55 * max_travel_m));
    if (excitation.cycle() != cycle) lows.push_back(1.0);
  }
  lows.pop_back();
  return lows;
}

}  // namespace

TEST_GROUP(Excitation){};

/// Where a small part of the power holds the muscle up, less than a twentieth of the power shows
/// its mechanics while it cools.
TEST(Excitation, StrokesReachTheirLowsAtAnyPower) {
  for (const double overpowered : {1.0, 3.0, 10.0}) {
    const Strokes strokes = strokes_of(overpowered);
    CHECK_EQUAL(Excitation::cycles, strokes.lowest_m.size());
    // All cycles except the first, which searches: alternately 0.15 and 0.25 of 0.55 of the travel.
    for (std::size_t i = 1; i < strokes.lowest_m.size(); ++i) {
      const double low_m = (i % 2 == 0 ? 0.15 : 0.25) * 0.55 * max_travel_m;
      CHECK_COMPARE(strokes.lowest_m[i], <, low_m + 0.02 * max_travel_m);
    }
    CHECK_COMPARE(strokes.took_s, <, 8 * 3.0 * thermal_s);
  }
}

/// The first stroke counts: it need not reach a low, which takes a slow muscle longest.
TEST(Excitation, ASlowMusclesFirstStrokeEndsAtHalfItsReach) {
  const Strokes strokes = strokes_of(2.0, false, 40.0);
  const double reach_m = 0.55 * max_travel_m;
  DOUBLES_EQUAL(0.5 * reach_m, strokes.ended_m[0], 0.02 * reach_m);
  DOUBLES_EQUAL(0.25 * reach_m, strokes.ended_m[1], 0.02 * reach_m);
  DOUBLES_EQUAL(0.15 * reach_m, strokes.ended_m[2], 0.02 * reach_m);
}

/// Play and creep hold a slow muscle in place for a while when its power changes.
TEST(Excitation, WaitsForAMuscleThatReversesSlowly) {
  for (const double lowest : lows_of_slow_muscle_with_play())
    CHECK_COMPARE(lowest, <, 0.55);
}

TEST(Excitation, AnExtensionRepeatsTheStrokesAtTheSamePace) {
  const Strokes once = strokes_of(3.0);
  const Strokes twice = strokes_of(3.0, true);
  CHECK_EQUAL(2 * Excitation::cycles, twice.lowest_m.size());
  for (std::size_t i = 0; i < once.lowest_m.size(); ++i)
    DOUBLES_EQUAL(once.lowest_m[i], twice.lowest_m[i], 1e-12);
  DOUBLES_EQUAL(2.0 * once.took_s, twice.took_s, 0.2 * once.took_s);
}

/// They do not begin at rest, because a slow muscle would take five time constants to get there.
TEST(Excitation, ShorterStrokesStartWhereTheLastOneEnded) {
  const FirstShorterStroke stroke = first_shorter_stroke();
  CHECK_COMPARE(stroke.lowest_m, >, 0.95 * stroke.began_m);
  DOUBLES_EQUAL(0.7 * 0.85 * 0.55 * max_travel_m, stroke.highest_m, 0.03 * max_travel_m);
}
