// Oscillations of the loop are distinguished from noise, steps and the reference's own.
#include "supercoil/control/tracking/oscillation_detector.hpp"

#include <CppUTest/TestHarness.h>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/tracking/controller.hpp"

#include "unit/control/support/muscle.hpp"

using namespace supercoil::control;

namespace {

constexpr double tick_s = 1e-3;

/// How often an oscillation is seen in 20 s.
template <class Error, class Model>
int seen(Error error_m, Model model_m) {
  OscillationDetector detector(tick_s);
  int count = 0;
  for (int k = 0; k < 20'000; ++k)
    count += detector.step(error_m(k * tick_s), model_m(k * tick_s)) ? 1 : 0;
  return count;
}

double at_rest(double) {
  return 0.0;
}

}  // namespace

TEST_GROUP(OscillationDetector){};

TEST(OscillationDetector, ReportsAnOscillationOncePerTenHalfPeriods) {
  const auto swing = [](double time_s) { return 1e-4 * std::sin(10.0 * time_s); };
  // 63 half periods; the first one begins before the detector can see it.
  LONGS_EQUAL(6, seen(swing, at_rest));
}

TEST(OscillationDetector, IgnoresSmallSlowAndFastMotion) {
  LONGS_EQUAL(0, seen([](double t_s) { return 4e-5 * std::sin(10.0 * t_s); }, at_rest));
  LONGS_EQUAL(0, seen([](double t_s) { return 1e-2 * std::sin(1.5 * t_s); }, at_rest));
  LONGS_EQUAL(0, seen([](double t_s) { return 1e-2 * std::sin(60.0 * t_s); }, at_rest));
}

TEST(OscillationDetector, IgnoresMotionOfTheReference) {
  const auto late = [](double time_s) { return 1e-3 * std::cos(10.0 * time_s); };
  LONGS_EQUAL(0, seen(late, [](double t_s) { return 2e-3 * std::sin(10.0 * t_s); }));
  LONGS_EQUAL(6, seen(late, [](double t_s) { return 2e-3 * std::sin(0.25 * t_s); }));
}

TEST(OscillationDetector, IgnoresNoise) {
  boost::random::mt19937 source(1);
  boost::random::normal_distribution<double> noise(0.0, 1e-3);
  LONGS_EQUAL(0, seen([&](double) { return noise(source); }, at_rest));
}

TEST(OscillationDetector, ReportsThePeriod) {
  OscillationDetector detector(tick_s);
  DOUBLES_EQUAL(0.0, detector.period_s(), 0.0);
  for (int k = 0; k < 20'000; ++k)
    detector.step(1e-3 * std::sin(7.0 * k * tick_s), 0.0);
  DOUBLES_EQUAL(2.0 * std::numbers::pi / 7.0, detector.period_s(), 0.01);
}

TEST(OscillationDetector, AGrowingOscillationIsReportedOnceItIsLarge) {
  CHECK(seen([](double t_s) { return 1e-6 * std::exp(0.3 * t_s) * std::sin(8.0 * t_s); }, at_rest) >
        0);
}

/// A load that swings by itself for minutes looks like an oscillation that nothing ends.
TEST(OscillationDetector, LeavesASeventeenthOfTheFeedbackUntilTheMuscleIsIdentified) {
  for (const auto kind : {ControllerKind::pi, ControllerKind::pd_ff, ControllerKind::adaptive_ff}) {
    ControllerSettings settings;
    settings.kind = kind;
    Controller controller(settings, tick_s);
    const Theta theta = theta_from(PhysicalParameters{});
    controller.retune(theta);
    const double configured = controller.gain(0).value;
    for (int k = 0; k < 300'000; ++k) {
      const double load_m = std::fmod(k * tick_s, 1.0) < 0.5 ? 0.3e-3 : -0.3e-3;
      controller.step({.reference_m = 0.011, .position_m = 0.011 + load_m});
    }
    DOUBLES_EQUAL(std::pow(0.7, 8.0), controller.gain(0).value / configured, 1e-3);
    controller.retune(theta);  // for the same muscle they stay lowered
    CHECK(controller.gain(0).value < 0.1 * configured);
    controller.retune(1.000001 * theta);
    DOUBLES_EQUAL(1.0, controller.gain(0).value / configured, 1e-3);
  }
}

TEST(OscillationDetector, SlowsALawDownUntilItTracksALightlyDampedMuscle) {
  PhysicalParameters muscle;
  muscle.damping_Ns_per_m = 0.12;
  for (const bool slow_down : {false, true}) {
    ControllerSettings settings;
    settings.kind = ControllerKind::adaptive_ff;
    settings.adaptive_ff.scale = {theta_from(muscle), muscle.dc_gain_m_per_W(),
                                  muscle.moving_mass_kg};
    settings.slow_when_oscillating = slow_down;
    Controller controller(settings, tick_s);
    controller.retune(theta_from(muscle));
    supercoil::test::Muscle plant(muscle, tick_s);
    const PowerRange range;
    double power_W = 0.0;
    bool limited = false;
    double max_m = 0.0;
    double period_s = 0.0;
    for (int k = 0; k < 80'000; ++k) {
      const auto out = controller.step({.reference_m = supercoil::test::paper_sine_m(k * tick_s),
                                        .position_m = plant.position_m(),
                                        .applied_power_W = power_W,
                                        .limited = limited});
      power_W = range.clip(out.demanded_power_W);
      limited = power_W != out.demanded_power_W;
      if (k > 55'000) max_m = std::fmax(max_m, std::abs(out.model_m - plant.position_m()));
      period_s = out.oscillation_period_s;
      plant.step(power_W);
    }
    // Near the muscle's own oscillation, 13.3 rad/s.
    CHECK(period_s > 0.3);
    CHECK(period_s < 0.7);
    CHECK_EQUAL(slow_down, max_m < 20e-6);
    if (!slow_down) CHECK(max_m > 1e-3);
  }
}
