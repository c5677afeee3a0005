// Adaptive feedforward with least squares, closed over the paper's muscle with a noisy sensor.
#include "supercoil/control/tracking/adaptive_feedforward.hpp"

#include <CppUTest/TestHarness.h>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>

#include "supercoil/control/estimation/estimator.hpp"
#include "supercoil/control/tracking/controller.hpp"

#include "unit/control/support/muscle.hpp"

using namespace supercoil::control;

namespace {

/// 5, 15, 8 and 20 mm, 20 s each.
double steps_m(double time_s) {
  constexpr std::array<double, 4> levels_m{0.005, 0.015, 0.008, 0.020};
  return levels_m[static_cast<std::size_t>(time_s / 20.0) % levels_m.size()];
}

struct Loop {
  double first_part = 1.0;   ///< of the true θ: what estimator and feedforward begin with
  double soft_from_s = 1e9;  ///< from then on the stiffness is 12 N/m
  double (*reference_m)(double) = supercoil::test::paper_sine_m;
  Arithmetic arithmetic = Arithmetic::float64;

  /// see(time_s, true error in µm) at each tick.
  template <class See>
  void run(double duration_s, See see) const {
    ControllerSettings c;
    c.kind = ControllerKind::adaptive_ff;
    c.arithmetic = arithmetic;
    c.model = design_model();
    EstimatorSettings e;
    e.kind = EstimatorKind::least_squares;
    e.least_squares.initial *= first_part;
    Controller controller(c, step_s);
    Estimator estimator(e, step_s);
    const Estimate first{.theta = e.least_squares.initial, .settled = true};
    for (int k = 0; k < 30'000; ++k)  // until its θ̄ is there
      controller.learn(first);

    boost::random::mt19937 source(1);
    boost::random::normal_distribution<double> noise(0.0, 10e-6);
    PhysicalParameters truth;
    supercoil::test::Muscle muscle(truth, step_s);
    const PowerRange range;
    double power_W = 0.0;
    bool limited = false;
    for (long k = 0; k < std::lround(duration_s / step_s); ++k) {
      const double time_s = static_cast<double>(k) * step_s;
      if (k == std::lround(soft_from_s / step_s)) {
        truth.stiffness_N_per_m = 12.0;
        muscle.change(truth);
      }
      const double seen_m =
          std::nearbyint((muscle.position_m() + noise(source)) / count_m) * count_m;
      estimator.step(seen_m, power_W);
      controller.learn(*estimator.estimate());
      const auto out = controller.step({.reference_m = reference_m(time_s),
                                        .position_m = seen_m,
                                        .applied_power_W = power_W,
                                        .limited = limited});
      see(time_s, 1e6 * (out.model_m - muscle.position_m()));
      power_W = range.clip(out.wanted_power_W);
      limited = power_W != out.wanted_power_W;
      muscle.step(power_W);
    }
  }

  static constexpr double step_s = 1e-3;
  static constexpr double count_m = 0.040 / 65536;
};

/// Of the errors within a span of time.
class Errors {
 public:
  Errors(double from_s, double to_s) : from_s_(from_s), to_s_(to_s) {}
  void add(double time_s, double error) {
    if (time_s < from_s_ || time_s >= to_s_) return;
    squares_ += error * error;
    largest_ = std::fmax(largest_, std::abs(error));
    count_ += 1.0;
  }
  double rms() const { return std::sqrt(squares_ / count_); }
  double largest() const { return largest_; }

 private:
  double from_s_;
  double to_s_;
  double squares_ = 0.0;
  double largest_ = 0.0;
  double count_ = 0.0;
};

}  // namespace

TEST_GROUP(AdaptiveFeedforward){};

TEST(AdaptiveFeedforward, FollowsTheSineWithin2MicrometresAndAgainAfterAChange) {
  Errors before(25.0, 50.0);
  Errors at_once(50.0, 51.0);
  Errors soon(51.0, 60.0);
  Errors after(110.0, 130.0);
  Loop{.soft_from_s = 50.0}.run(130.0, [&](double time_s, double error_um) {
    for (Errors* errors : {&before, &at_once, &soon, &after})
      errors->add(time_s, error_um);
  });
  UT_PRINT(StringFromFormat("um: %.2f rms, change %.0f most, then %.0f most, %.2f rms",
                            before.rms(), at_once.largest(), soon.largest(), after.rms())
               .asCharString());
  CHECK(before.rms() <= 2.0);
  CHECK(after.rms() <= 3.0);
}

TEST(AdaptiveFeedforward, FollowsStepsWithin5Micrometres) {
  Errors late(60.0, 100.0);
  Loop{.reference_m = steps_m}.run(
      100.0, [&](double time_s, double error_um) { late.add(time_s, error_um); });
  UT_PRINT(StringFromFormat("um: %.2f rms", late.rms()).asCharString());
  CHECK(late.rms() <= 5.0);
}

TEST(AdaptiveFeedforward, StartsFrom55PercentOfTheTrueParameters) {
  Errors first(0.0, 3.0);
  Errors second(3.0, 10.0);
  Errors third(10.0, 20.0);
  Loop{.first_part = 0.55}.run(20.0, [&](double time_s, double error_um) {
    for (Errors* errors : {&first, &second, &third})
      errors->add(time_s, error_um);
  });
  UT_PRINT(StringFromFormat("um: %.0f, %.0f, %.1f rms", first.rms(), second.rms(), third.rms())
               .asCharString());
  CHECK(third.rms() <= 10.0);
}

TEST(AdaptiveFeedforward, FloatAndFixedPointFollowAsWell) {
  for (const Arithmetic arithmetic : {Arithmetic::float32, Arithmetic::q8_24}) {
    Errors late(25.0, 40.0);
    Loop{.arithmetic = arithmetic}.run(
        40.0, [&](double time_s, double error_um) { late.add(time_s, error_um); });
    CHECK(late.rms() <= 2.0);
  }
}

TEST(AdaptiveFeedforward, DoesNotFollowAnEstimateThatHasNotSettled) {
  AdaptiveFeedforward<double> law({}, 1e-3);
  Estimate estimate{.theta = RegressionScale{}.nominal * 3.0, .bias_W = 1.0};
  law.learn(estimate);
  CHECK((law.theta() - AdaptiveFeedforward<double>::Parameters{1.0, 1.0, 1.0, 1.0, 0.0}).norm() ==
        0);
  estimate.settled = true;
  for (int k = 0; k < 1000; ++k)
    law.learn(estimate);
  DOUBLES_EQUAL(3.0 - 2.0 * std::exp(-1.0), law.theta()[0], 1e-3);
  DOUBLES_EQUAL(1.0 - std::exp(-1.0), law.theta()[4], 1e-3);
}

TEST(AdaptiveFeedforward, TakesAHeldPowerOver) {
  ControllerSettings settings;
  settings.kind = ControllerKind::adaptive_ff;
  Controller controller(settings, 1e-3);
  controller.start({.reference_m = 0.01,
                    .position_m = 0.0101,
                    .power_W = 1.7,
                    .motion = {0.01, 0.0, 0.0},
                    .hold = true});
  const auto out = controller.step(
      {.reference_m = 0.01, .position_m = 0.0101, .applied_power_W = 1.7, .limited = false});
  DOUBLES_EQUAL(1.7, out.wanted_power_W, 1e-3);
}

TEST(AdaptiveFeedforward, HoldsItsIntegralAtTheLimitAndLetsItOnlyLeadOut) {
  AdaptiveFeedforward<double> law({}, 1e-3);
  const auto step = [&](double error_W, double applied_W) {
    LawInput<double> in;
    in.model.position = error_W;
    in.applied = applied_W;
    in.limited = true;
    return law.step(in);
  };
  step(1.0, 4.5);
  const double held = step(1.0, 4.5);
  for (int k = 0; k < 1000; ++k)  // above the upper limit, pushing on
    DOUBLES_EQUAL(held, step(1.0, 4.5), 1e-12);
  const double turned = step(-1.0, 4.5);  // still above, and the error leads out
  const double out = step(-1.0, -99.0);
  CHECK(out < turned);
}
