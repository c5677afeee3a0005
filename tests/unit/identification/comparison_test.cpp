// Models are chosen by data that they were not fitted to; data that no muscle makes is reported.
#include <algorithm>
#include <cmath>

#include <CppUTest/TestHarness.h>

#include "unit/identification/support/simulated.hpp"

namespace {

using namespace supercoil::identification;
using namespace supercoil::identification::test;

Comparison compared(const Muscle& muscle) {
  Samples samples = random_steps(120.0, full_W, 21);
  record(muscle, noise_m, 22, samples);
  return compare(samples, {{0.0, 80.0}, {80.0, 120.0}});
}

void check_chosen(const Effects& expected, const Comparison& comparison) {
  STRCMP_EQUAL(name(expected).c_str(), name(comparison.best().fit.effects).c_str());
  STRCMP_EQUAL("", comparison.rejection_reason.c_str());
}

}  // namespace

TEST_GROUP(Comparison){};

TEST(Comparison, ChoosesTheLinearModelForALinearMuscle) {
  const Comparison c = compared(other_muscle());
  check_chosen({}, c);
  DOUBLES_EQUAL(1e-5, c.best().unseen_rms_m, 1e-6);
  CHECK(c.best().unseen_explained > 0.999);
}

TEST(Comparison, ChoosesTheEffectOfTheMuscle) {
  Muscle both = other_muscle();
  both.drift_m_per_s = 5e-5;
  both.transfer_ratio = 2.0;
  check_chosen({Effect::drift, Effect::heat_transfer}, compared(both));
  Muscle force = other_muscle();
  force.force_ratio = 2.5;
  check_chosen({Effect::force}, compared(force));
}

TEST(Comparison, RecognisesAMaterialWithAPhaseTransformation) {
  Muscle wire = other_muscle();
  wire.transformation_W = 1.0;
  wire.transformed_W = 0.08;
  const Comparison c = compared(wire);
  STRCMP_CONTAINS("shape-memory wire", c.rejection_reason.c_str());
  CHECK(c.transformation.unseen_rms_m < 0.01 * c.sizes.stroke_m);
}

TEST(Comparison, ReportsMotionThatPowerDoesNotExplain) {
  Samples samples = random_steps(120.0, full_W, 23);
  record(other_muscle(), noise_m, 24, samples);
  // A disturbance that grows and grows pulls at the muscle.
  for (std::size_t k = 0; k < samples.size(); ++k)
    samples.position_m[k] += 2e-4 * samples.time_s(k) * std::sin(0.7 * samples.time_s(k));
  const Comparison c = compare(samples, {{0.0, 80.0}, {80.0, 120.0}});
  STRCMP_CONTAINS("no model predicts", c.rejection_reason.c_str());
}

TEST(Comparison, NamesTheOptionForAPositionThatCountsBackwards) {
  Samples samples = random_steps(120.0, full_W, 27);
  record(other_muscle(), noise_m, 28, samples);
  for (double& position_m : samples.position_m)
    position_m = 0.02 - position_m;
  const Comparison c = compare(samples, {{0.0, 80.0}, {80.0, 120.0}});
  STRCMP_CONTAINS("--position-scale -1", c.rejection_reason.c_str());
}

TEST(Comparison, NamesAMuscleThatChangedBetweenTheParts) {
  Samples samples = random_steps(120.0, full_W, 29);
  record(other_muscle(), noise_m, 30, samples);
  // It softens by a quarter, so that every motion is a third larger.
  for (std::size_t k = 4000; k < samples.size(); ++k)
    samples.position_m[k] *= 4.0 / 3.0;
  const Comparison c = compare(samples, {{0.0, 80.0}, {80.0, 120.0}});
  STRCMP_CONTAINS("changed between 0 to 80 s and 80 to 120 s: gain_m_per_W by +33 %",
                  c.rejection_reason.c_str());
}

/// Of a muscle with a time constant of 9 s.
TEST(Comparison, SaysHowLongToRecordWhenARecordingIsTooShort) {
  for (const double duration_s : {3.0, 8.0}) {
    Samples samples = random_steps(duration_s, full_W, 31);
    std::fill(samples.power_W.begin() + 25, samples.power_W.end(), full_W);
    record(other_muscle(), noise_m, 32, samples);
    const double middle_s = 2.0 / 3.0 * duration_s;
    const Comparison c = compare(samples, {{0.0, middle_s}, {middle_s, duration_s}});
    STRCMP_CONTAINS("too short", c.rejection_reason.c_str());
  }
}

TEST(Comparison, ReportsAChangeOnlyWhenThereIsOne) {
  Samples samples = random_steps(120.0, full_W, 25);
  record(other_muscle(), noise_m, 26, samples);
  const Fit part = fit_model({}, samples, {0.0, 60.0});
  CHECK(max_change(part, fit_model({}, samples, {0.0, 120.0})).deviations < 3.0);
  // From 60 s on every motion is a quarter larger.
  for (std::size_t k = 3000; k < samples.size(); ++k)
    samples.position_m[k] *= 1.25;
  const Change change = max_change(part, fit_model({}, samples, {0.0, 120.0}));
  CHECK(change.deviations > 3.0);
}

TEST_GROUP(Parts){};

TEST(Parts, ValidatesOnTheLastHeatingFromRest) {
  Samples samples;
  samples.step_s = 0.02;
  samples.power_W.assign(5000, 0.0);
  samples.position_m.assign(5000, 0.0);
  for (const std::size_t from : {500U, 2500U}) {
    for (std::size_t k = from; k < from + 200; ++k)
      samples.power_W[k] = 1.0;
  }
  const Parts parts = default_parts(samples);
  DOUBLES_EQUAL(0.0, parts.fitted.from_s, 1e-9);
  DOUBLES_EQUAL(49.99, parts.fitted.to_s, 1e-9);
  DOUBLES_EQUAL(49.99, parts.unseen.from_s, 1e-9);
  DOUBLES_EQUAL(99.98, parts.unseen.to_s, 1e-9);
}

TEST(Parts, ValidatesOnTheLastThirdWithoutRests) {
  const Parts parts = default_parts([] {
    Samples samples;
    samples.step_s = 0.02;
    samples.power_W.assign(6001, 1.0);
    samples.position_m.assign(6001, 0.0);
    return samples;
  }());
  DOUBLES_EQUAL(79.99, parts.fitted.to_s, 1e-9);
}
