#include "supercoil/control/tracking/reference_model.hpp"

#include <CppUTest/TestHarness.h>

#include "unit/control/support/reference.hpp"

using namespace supercoil::control;

namespace {

/// The model's motion after a step of 1 held for the time.
ModelMotion<double> after_step(const ReferenceModelSettings& settings, double step_s, long ticks) {
  ReferenceModel<double> model(settings, step_s);
  for (long k = 0; k < ticks; ++k)
    model.step(1.0);
  return model.motion();
}

double overshoot(const ReferenceModelSettings& settings) {
  ReferenceModel<double> model(settings, 1e-3);
  double peak = 0.0;
  for (int k = 0; k < 60000; ++k) {
    model.step(1.0);
    peak = std::fmax(peak, model.motion().position);
  }
  return peak - 1.0;
}

}  // namespace

TEST_GROUP(ReferenceModels){};

TEST(ReferenceModels, StepResponsesAgreeWithScipy) {
  for (const auto& c : supercoil::test::reference("tracking", "models")) {
    const auto settings = reference_model_named(c.at("name").get<std::string>());
    CHECK(settings.has_value());
    DOUBLES_EQUAL(c.at("dc_gain"), settings->dc_gain(), 1e-12);
    const std::vector<double> times = c.at("time_s");
    const std::vector<double> response = c.at("response");
    for (std::size_t i = 0; i < times.size(); ++i) {
      const auto motion = after_step(*settings, 1e-2, std::lround(times[i] / 1e-2));
      DOUBLES_EQUAL(response[i], motion.position, 1e-9);
    }
  }
}

TEST(ReferenceModels, OvershootAgreesWithScipyAndIsFortyPercentForEq8) {
  for (const auto& c : supercoil::test::reference("tracking", "models")) {
    DOUBLES_EQUAL(c.at("overshoot"),
                  overshoot(*reference_model_named(c.at("name").get<std::string>())), 1e-6);
  }
  DOUBLES_EQUAL(0.403, overshoot(eq8_model()), 0.0005);
  CHECK(overshoot(design_model()) < 0.05);  // what the paper's text asks for
}

TEST(ReferenceModels, PolesModelHasItsPolesAndUnitDcGain) {
  const auto model = poles_model({2.0, 3.0, 7.0});
  DOUBLES_EQUAL(1.0, model.dc_gain(), 1e-15);
  for (const double pole : {2.0, 3.0, 7.0}) {
    const double s = -pole;
    const auto& d = model.denominator;
    DOUBLES_EQUAL(0.0, d[0] + s * (d[1] + s * (d[2] + s * d[3])), 1e-12);
  }
  DOUBLES_EQUAL(16.0, wm16_model().gain, 1e-12);
}

TEST(ReferenceModels, VelocityAndAccelerationAreThePositionsDerivatives) {
  const double step_s = 1e-3;
  const auto before = after_step(design_model(), step_s, 999);
  const auto now = after_step(design_model(), step_s, 1000);
  const auto after = after_step(design_model(), step_s, 1001);
  DOUBLES_EQUAL((after.position - before.position) / (2 * step_s), now.velocity, 1e-6);
  DOUBLES_EQUAL((after.velocity - before.velocity) / (2 * step_s), now.acceleration, 1e-6);
}

// A sine of 2 rad/s, of which the design model by itself would pass only a tenth.
TEST(ReferenceModels, FollowAMotion) {
  constexpr double step_s = 1e-3;
  constexpr double turn = 2.0;
  const auto sine = [](double time_s) {
    const double s = std::sin(turn * time_s);
    const double c = std::cos(turn * time_s);
    return TrajectoryPoint{{s, turn * c, -turn * turn * s}, -turn * turn * turn * c};
  };
  for (const auto& settings : {design_model(), eq8_model(), wm16_model()}) {
    ReferenceModel<double> model(settings, step_s);
    model.set(sine(0.0).motion);
    for (int k = 0; k < 10000; ++k) {
      DOUBLES_EQUAL(sine(k * step_s).motion.position, model.motion().position, 1e-3);
      model.step(settings.reference_for(sine(k * step_s), model.motion()));
    }
    const ModelMotion<double> rest{3.0, 0.0, 0.0};
    DOUBLES_EQUAL(3.0 / settings.dc_gain(), settings.reference_for({rest}, rest), 1e-12);
  }
}

// 1 off, it is within 0.02 after 1.6 s, as three poles at 5 rad/s are.
TEST(ReferenceModels, ConvergeToAMotion) {
  for (const auto& settings : {design_model(), eq8_model(), wm16_model()}) {
    ReferenceModel<double> model(settings, 1e-3);
    for (int k = 0; k < 1600; ++k)
      model.step(settings.reference_for({{1.0, 0.0, 0.0}}, model.motion()));
    DOUBLES_EQUAL(1.0, model.motion().position, 0.02);
  }
}

TEST(ReferenceModels, AnUnknownNameGivesNoModel) {
  CHECK_FALSE(reference_model_named("eq9").has_value());
}
