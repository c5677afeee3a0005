// Feedforward that learns its own motion, in closed loop with the paper's muscle and a noisy
// sensor. For non-linear muscles see tests/unit/host_sim/plant/learned_feedforward_test.cpp.
#include "supercoil/control/tracking/learned_feedforward.hpp"

#include <CppUTest/TestHarness.h>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>

#include "supercoil/control/actuator/conversions.hpp"

#include "unit/control/support/noisy_loop.hpp"

using namespace supercoil::control;
using supercoil::test::NoisyLoop;

namespace {

NoisyLoop learning_loop() {
  NoisyLoop loop;
  loop.controller.kind = ControllerKind::learned_ff;
  loop.controller.model = design_model();
  return loop;
}

void scale_model(NoisyLoop& loop, const Theta& factors) {
  loop.controller.learned_ff.scale.nominal =
      loop.controller.learned_ff.scale.nominal.cwiseProduct(factors);
}

}  // namespace

TEST_GROUP(LearnedFeedforward){};

TEST(LearnedFeedforward, FollowsTheSineWithinHalfAMicrometreBeforeAndAfterAChange) {
  NoisyLoop loop = learning_loop();
  loop.soft_from_s = 110.0;
  const auto um = loop.rms_um<2>({{{60.0, 110.0}, {185.4, 260.8}}});
  UT_PRINT(
      StringFromFormat("um: %.2f, 4th to 6th period after %.2f rms", um[0], um[1]).asCharString());
  CHECK(um[0] <= 0.5);
  CHECK(um[1] <= 1.0);
  loop.controller.learned_ff.adapt_bandwidth = false;
  CHECK(loop.rms_um<1>({{{60.0, 110.0}}})[0] <= 1.0);
}

TEST(LearnedFeedforward, FollowsStepsWithinHalfAMicrometre) {
  NoisyLoop loop = learning_loop();
  loop.reference_m = supercoil::test::paper_steps_m;
  const auto um = loop.rms_um<1>({{{160.0, 240.0}}});
  UT_PRINT(StringFromFormat("um: %.2f rms", um[0]).asCharString());
  CHECK(um[0] <= 0.5);
  loop.controller.learned_ff.adapt_bandwidth = false;
  CHECK(loop.rms_um<1>({{{160.0, 240.0}}})[0] <= 1.0);
}

TEST(LearnedFeedforward, LearnsAMuscleWhoseModelIs30PercentOff) {
  NoisyLoop loop = learning_loop();
  scale_model(loop, {1.3, 0.7, 1.3, 0.7});
  CHECK(loop.rms_um<1>({{{100.0, 150.0}}})[0] <= 1.5);
  loop.controller.learned_ff.learn = false;
  CHECK(loop.rms_um<1>({{{100.0, 150.0}}})[0] > 10.0);
}

TEST(LearnedFeedforward, IterativeLearningFollowsAPeriodicReferenceAndForgetsItAfterAChange) {
  NoisyLoop loop = learning_loop();
  scale_model(loop, {1.3, 0.7, 1.3, 0.7});
  loop.controller.learned_ff.learn = false;
  const double period_s = 8.0 * std::atan(1.0) / 0.25;
  const double once_um = loop.rms_um<1>({{{200.0, 251.0}}})[0];
  loop.controller.learned_ff.period_s = period_s;
  const double often_um = loop.rms_um<1>({{{200.0, 251.0}}})[0];
  UT_PRINT(StringFromFormat("um: %.2f rms without, %.2f with", once_um, often_um).asCharString());
  CHECK(often_um < 0.2 * once_um);
  loop.controller.learned_ff.learn = true;
  CHECK(loop.rms_um<1>({{{200.0, 251.0}}})[0] <= 1.3);
  loop.soft_from_s = 110.0;
  CHECK(loop.rms_um<1>({{{185.4, 260.8}}})[0] <= 4.0);
}

TEST(LearnedFeedforward, IterativeLearningFollowsADetectedPeriodUntilItEnds) {
  NoisyLoop loop = learning_loop();
  scale_model(loop, {1.3, 0.7, 1.3, 0.7});
  loop.controller.learned_ff.learn = false;
  loop.reference_m = [](double time_s) {
    return 0.011 + 0.009 * std::sin(time_s < 251.0 ? 0.25 * time_s : 0.4 * time_s - 37.65);
  };
  const auto once_um = loop.rms_um<2>({{{200.0, 251.0}, {255.0, 280.0}}});
  loop.controller.learned_ff.find_period = true;
  const auto found_um = loop.rms_um<2>({{{200.0, 251.0}, {255.0, 280.0}}});
  UT_PRINT(StringFromFormat("um: %.2f and %.2f rms without, %.2f and %.2f with", once_um[0],
                            once_um[1], found_um[0], found_um[1])
               .asCharString());
  CHECK(found_um[0] < 0.2 * once_um[0]);
  CHECK(found_um[1] < 1.2 * once_um[1]);
}

TEST(LearnedFeedforward, FloatFollowsEquallyWell) {
  NoisyLoop loop = learning_loop();
  loop.controller.arithmetic = Arithmetic::float32;
  CHECK(loop.rms_um<1>({{{40.0, 65.0}}})[0] <= 1.5);
}

TEST(LearnedFeedforward, LearnsNothingWhileThePowerIsLimited) {
  LearnedFeedforward<double> law({}, 1e-3);
  law.start({});
  const auto before = law.weights();
  LawInput<double> in;
  in.model.position = 2.0;
  in.limited = true;
  in.applied = 1.0;
  for (int k = 0; k < 20'000; ++k)
    (void)law.step(in);
  CHECK((law.weights() - before).norm() == 0.0);
}

TEST(LearnedFeedforward, ReportsTheGainsInUse) {
  LearnedFeedforwardSettings settings;
  settings.learn = false;
  LearnedFeedforward<double> law(settings, 1e-3);
  law.start({});
  const double before = law.gain(0).value;
  boost::random::mt19937 source(1);
  boost::random::normal_distribution<double> noise(0.0, 1e-3);
  LawInput<double> in;
  for (int k = 0; k < 60'000; ++k) {
    in.position = noise(source);
    (void)law.step(in);
  }
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(law.gain(i).value > 0.0);
  CHECK(law.gain(0).value <= 0.25 * before);
}

TEST(LearnedFeedforward, ALightlyDampedMuscleGetsLessBandwidth) {
  PhysicalParameters muscle;
  const Theta usual = theta_from(muscle);
  DOUBLES_EQUAL(8.0, feedback_bandwidth(8.0, usual, muscle.moving_mass_kg), 1e-12);
  muscle.damping_Ns_per_m = 0.12;  // a damping ratio of 0.05
  const double lowered = feedback_bandwidth(8.0, theta_from(muscle), muscle.moving_mass_kg);
  CHECK(lowered > 0.3);
  CHECK(lowered < 1.0);
}
