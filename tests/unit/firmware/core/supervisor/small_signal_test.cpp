// How much of a small motion reaches the sensor.
#include "supervisor/small_signal.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <CppUTest/TestHarness.h>

#include "unit/firmware/core/support/paper_proof.hpp"

using namespace supercoil;
using test::paper_proof;

namespace {

constexpr double rate_Hz = 1000.0;
constexpr double held_W = 0.6;

struct Sensor {
  double ratio = 1.0;   ///< fraction of the motion that arrives
  double play_m = 0.0;  ///< the sensor's end follows only beyond this play
  double noise_m = 10e-6;
};

/// The ratio measured for the paper's muscle with this sensor.
double measured_ratio(const Sensor& sensor, const ProofSettings& settings = paper_proof()) {
  const control::PhysicalParameters muscle;
  ExpectedMotion motion(muscle, 1.0 / rate_Hz);
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0.0, sensor.noise_m);
  SmallSignal measuring;
  const auto plan = plan_small_signal(settings, muscle, held_W, INFINITY, rate_Hz);
  measuring.start(plan, ExpectedMotion(muscle, plan.step_s));
  double end_m = 0.0;
  double power_W = 0.0;
  bool goes_on = true;
  for (int i = 0; goes_on && i < 60'000; ++i) {
    const double muscle_m = motion.step(power_W);
    end_m = std::clamp(end_m, muscle_m - sensor.play_m, muscle_m + sensor.play_m);
    goes_on = measuring.step(sensor.ratio * end_m + noise(random), power_W);
    power_W = measuring.power_W();
  }
  CHECK_FALSE(goes_on);
  return measuring.response_ratio();
}

}  // namespace

TEST_GROUP(SmallSignal){};

TEST(SmallSignal, RatioOfALinearMuscleIsItsGainRatio) {
  for (const double ratio : {0.3, 1.0, 1.6})
    DOUBLES_EQUAL(ratio, measured_ratio({.ratio = ratio}), 0.05);
}

TEST(SmallSignal, IsAbsorbedByPlayBetweenMuscleAndSensor) {
  CHECK_COMPARE(measured_ratio({.play_m = 100e-6}), <, 0.05);
}

TEST(SmallSignal, IsUnknownBehindNoise) {
  ProofSettings noisy = paper_proof();
  noisy.position_noise_rms_m = 500e-6;
  DOUBLES_EQUAL(0.0, measured_ratio({.noise_m = 500e-6}, noisy), 0.0);
}

TEST(SmallSignal, StopEndsIt) {
  SmallSignal measuring;
  CHECK_FALSE(measuring.running());
  const auto plan = plan_small_signal(paper_proof(), {}, held_W, INFINITY, rate_Hz);
  measuring.start(plan, ExpectedMotion({}, plan.step_s));
  CHECK(measuring.running());
  measuring.stop();
  CHECK_FALSE(measuring.running());
}

TEST(SmallSignal, IsPlannedInStepsOfWholeTicksAfterFiveTimeConstants) {
  const control::PhysicalParameters muscle;
  for (const double other_Hz : {150.0, 1000.0}) {
    const auto plan = plan_small_signal(paper_proof(), muscle, held_W, INFINITY, other_Hz);
    DOUBLES_EQUAL(other_Hz, plan.rate_Hz, 0.0);
    DOUBLES_EQUAL(other_Hz == 150.0 ? 2.0 / 150.0 : 0.01, plan.step_s, 1e-12);
    DOUBLES_EQUAL(-5.0 / muscle.thermal_pole_rad_per_s(), plan.settle_s, 1e-9);
  }
}

/// Also with a power too near to either limit for both halves of a dither.
TEST(SmallSignal, IsPlannedWithinAMinuteAndWithHeadroom) {
  control::PhysicalParameters slow;
  slow.thermal_mass_J_per_K = 15.0 * slow.heat_transfer_W_per_K;
  DOUBLES_EQUAL(45.0, plan_small_signal(paper_proof(), slow, held_W, INFINITY, rate_Hz).settle_s,
                0.0);
  const auto low = plan_small_signal(paper_proof(), {}, 0.0, INFINITY, rate_Hz);
  DOUBLES_EQUAL(2.0 * low.dither.amplitude_W, low.hold_W, 1e-12);
  DOUBLES_EQUAL(2.25, plan_small_signal(paper_proof(), {}, 4.5, INFINITY, rate_Hz).hold_W, 1e-12);
}

/// As little as it may be, both halves of the dither fit.
TEST(SmallSignal, HoldsNoMorePowerThanItMay) {
  const auto free = plan_small_signal(paper_proof(), {}, held_W, INFINITY, rate_Hz);
  const double little_W = 0.5 * free.dither.amplitude_W;
  const auto plan = plan_small_signal(paper_proof(), {}, held_W, little_W, rate_Hz);
  DOUBLES_EQUAL(little_W, plan.hold_W, 1e-12);
  DOUBLES_EQUAL(0.5 * little_W, plan.dither.amplitude_W, 1e-12);
}

TEST(SmallSignal, AmplitudeIgnoresTheResponseOfAnEarlierMuscle) {
  ProofSettings rubbed = paper_proof();
  rubbed.response_ratio = 0.5;
  DOUBLES_EQUAL(plan_small_signal(paper_proof(), {}, held_W, INFINITY, rate_Hz).dither.amplitude_W,
                plan_small_signal(rubbed, {}, held_W, INFINITY, rate_Hz).dither.amplitude_W, 0.0);
}

/// For 4 s, of a slow dither for 10 s or four periods, of the slowest for two; and one period
/// before.
TEST(SmallSignal, TakesTheTimeThatItsDitherNeeds) {
  struct {
    int half_steps;
    int periods;
  } const cases[]{{20, 10}, {70, 4}, {100, 4}, {150, 3}, {350, 2}, {600, 2}};
  for (const auto& [half_steps, periods] : cases) {
    SmallSignal::Settings plan;
    plan.dither.half_steps = half_steps;
    plan.rate_Hz = 100.0;
    SmallSignal measuring;
    measuring.start(plan, ExpectedMotion({}, plan.step_s));
    int steps = 1;
    while (measuring.step(0.0, 0.0))
      ++steps;
    LONGS_EQUAL((1 + periods) * 2 * half_steps, steps);
  }
}

/// Without settling and without noise, from the very first step on.
TEST(SmallSignal, RatioOfTheModelsOwnMotionIsOne) {
  const control::PhysicalParameters muscle;
  auto plan = plan_small_signal(paper_proof(), muscle, held_W, INFINITY, rate_Hz);
  plan.settle_s = plan.hold_W = 0.0;
  SmallSignal measuring;
  measuring.start(plan, ExpectedMotion(muscle, plan.step_s));
  ExpectedMotion motion(muscle, plan.step_s);
  const long ticks = std::lround(rate_Hz * plan.step_s);
  double power_W = 0.0;
  for (int step = 0; measuring.running() && step < 10'000; ++step) {
    const double position_m = motion.step(power_W);
    for (long i = 0; i < ticks; ++i)
      measuring.step(position_m, power_W);
    power_W = measuring.power_W();
  }
  CHECK_FALSE(measuring.running());
  DOUBLES_EQUAL(1.0, measuring.response_ratio(), 1e-9);
}
