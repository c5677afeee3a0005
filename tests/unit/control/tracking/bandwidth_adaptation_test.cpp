// How fast a feedback becomes on a loop whose best bandwidth is known: an integrator, as FixedPid
// leaves it, moved by noise; its Kalman filter has the gain ωc = √(Q/R).
#include "supercoil/control/tracking/bandwidth_adaptation.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>

using supercoil::control::BandwidthAdaptation;

namespace {

struct AdaptedLoop {
  explicit AdaptedLoop(double tick_s = 1e-3)
      : step_s(tick_s),
        bandwidth({.max_rad_per_s = 8.0, .lag_rad_per_s = 22.0, .step_s = tick_s}) {}

  /// Sensor noise of 1; wander: random motion of the loop in one second; push: steady motion, in
  /// 1/s.
  void run(double duration_s, double wander = 0.0, double push = 0.0, bool limited = false) {
    const auto ticks = std::lround(duration_s / step_s);
    double squares = 0.0;
    for (long k = 0; k < ticks; ++k) {
      const double error = true_error - noise(source);
      bandwidth.step(error, limited);
      lagged += -std::expm1(-22.0 * step_s) * (error - lagged);
      true_error += step_s * (push - max_rad_per_s * bandwidth.ratio() * lagged) +
                    wander * std::sqrt(step_s) * noise(source);
      squares += true_error * true_error;
    }
    rms = std::sqrt(squares / static_cast<double>(ticks));
  }

  double step_s;
  double max_rad_per_s = 8.0;  ///< true bandwidth of the loop at ratio 1
  BandwidthAdaptation bandwidth;
  double true_error = 0.0;
  double lagged = 0.0;
  double rms = 0.0;  ///< of the true error in the last run
  boost::random::mt19937 source{1};
  boost::random::normal_distribution<double> noise{0.0, 1.0};
};

/// √R for noise with one reading each millisecond.
const double noise_density = std::sqrt(1e-3);

}  // namespace

TEST_GROUP(BandwidthAdaptation){};

TEST(BandwidthAdaptation, StartsAtFullBandwidth) {
  AdaptedLoop loop;
  DOUBLES_EQUAL(1.0, loop.bandwidth.ratio(), 0.0);
  loop.run(0.4);
  DOUBLES_EQUAL(1.0, loop.bandwidth.ratio(), 0.0);
}

TEST(BandwidthAdaptation, IsLowWhereThereIsOnlyNoise) {
  AdaptedLoop loop;
  loop.run(200.0);
  loop.run(200.0);
  CHECK(loop.bandwidth.ratio() <= 1.0 / 16.0);
  const double quick_rms = std::sqrt(0.5 * 8.0 * loop.step_s);
  CHECK(loop.rms < 0.5 * quick_rms);
}

TEST(BandwidthAdaptation, MatchesTheKalmanFilterBandwidth) {
  for (const double best_rad_per_s : {4.0, 2.0, 1.0}) {
    AdaptedLoop loop;
    loop.run(600.0, best_rad_per_s * noise_density);
    const double bandwidth = 8.0 * loop.bandwidth.ratio();
    CHECK(bandwidth >= 0.5 * best_rad_per_s);
    CHECK(bandwidth <= 2.0 * best_rad_per_s);
  }
}

TEST(BandwidthAdaptation, IsFullWhereMoreWouldBeOptimal) {
  AdaptedLoop loop;
  loop.run(300.0, 16.0 * noise_density);
  DOUBLES_EQUAL(1.0, loop.bandwidth.ratio(), 0.0);
}

TEST(BandwidthAdaptation, IsFullImmediatelyAfterAChange) {
  AdaptedLoop loop;
  loop.run(400.0);
  CHECK(loop.bandwidth.ratio() <= 1.0 / 16.0);
  loop.run(0.02, 0.0, 1000.0);
  DOUBLES_EQUAL(1.0, loop.bandwidth.ratio(), 0.0);
  // Its consequences must not count for minutes.
  loop.run(2.0, 0.0, 1000.0);
  loop.run(40.0);
  CHECK(loop.bandwidth.ratio() < 1.0);
}

TEST(BandwidthAdaptation, RisesAgainUnderASlowDisturbance) {
  AdaptedLoop loop;
  loop.run(400.0);
  loop.run(30.0, 16.0 * noise_density);
  DOUBLES_EQUAL(1.0, loop.bandwidth.ratio(), 0.0);
}

TEST(BandwidthAdaptation, LearnsNothingWhileThePowerIsLimited) {
  AdaptedLoop loop;
  loop.run(200.0, 0.0, 0.0, true);
  DOUBLES_EQUAL(1.0, loop.bandwidth.ratio(), 0.0);
}

TEST(BandwidthAdaptation, AccountsForLoweredGains) {
  AdaptedLoop loop;
  loop.max_rad_per_s = 2.0;
  loop.bandwidth.scale(0.25);
  loop.run(600.0, 1.0 * noise_density);
  const double bandwidth = 2.0 * loop.bandwidth.ratio();
  CHECK(bandwidth >= 0.5);
  CHECK(bandwidth <= 1.0);
}

TEST(BandwidthAdaptation, ATickTooCoarseForTheLoopChangesNothing) {
  AdaptedLoop loop(0.1);
  loop.run(1000.0);
  DOUBLES_EQUAL(1.0, loop.bandwidth.ratio(), 0.0);
}

TEST(BandwidthAdaptation, RestartsAtFullBandwidth) {
  AdaptedLoop loop;
  loop.run(200.0);
  loop.bandwidth.restart();
  DOUBLES_EQUAL(1.0, loop.bandwidth.ratio(), 0.0);
  loop.run(0.4);
  DOUBLES_EQUAL(1.0, loop.bandwidth.ratio(), 0.0);
}
