// Fits find muscles that they did not start from, and say how well.
#include <cmath>
#include <string>

#include <CppUTest/TestHarness.h>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/identification/physical.hpp"

#include "unit/identification/support/simulated.hpp"

namespace {

using namespace supercoil::identification;
using namespace supercoil::identification::test;

constexpr Span all{0.0, 1e6};

std::size_t index_of(const Fit& fit, double Muscle::*member) {
  for (std::size_t i = 0; i < fit.parameters.size(); ++i)
    if (fit.parameters[i].member == member) return i;
  FAIL("the model has no such parameter");
  return 0;
}

/// Within this ratio of the truth, and within three of the fit's own deviations.
void check_found(const Fit& fit, const Muscle& truth, double Muscle::*member, double ratio) {
  const std::size_t i = index_of(fit, member);
  const double expected = truth.*member;
  const std::string name(fit.parameters[i].name);
  DOUBLES_EQUAL_TEXT(expected, fit.muscle.*member, ratio * std::abs(expected), name.c_str());
  DOUBLES_EQUAL_TEXT(expected, fit.muscle.*member, 3.0 * fit.deviation(i), name.c_str());
}

}  // namespace

TEST_GROUP(FitModel){};

TEST(FitModel, FindsALinearMuscleFromFarAway) {
  Samples samples = random_steps(60.0, full_W, 1);
  const Muscle truth = other_muscle();
  record(truth, noise_m, 2, samples);
  const Fit found = fit_model({}, samples, all);
  check_found(found, truth, &Muscle::gain_m_per_W, 0.002);
  check_found(found, truth, &Muscle::time_constant_s, 0.002);
  check_found(found, truth, &Muscle::natural_frequency_rad_per_s, 0.02);
  check_found(found, truth, &Muscle::damping_ratio, 0.02);
  check_found(found, truth, &Muscle::rest_m, 0.01);
  DOUBLES_EQUAL(noise_m, found.rms_m, 0.05 * noise_m);
}

TEST(FitModel, FindsAMuscleThatStartsWarm) {
  Samples samples = random_steps(60.0, full_W, 3);
  Muscle truth = other_muscle();
  truth.start_W = 1.2;
  record(truth, noise_m, 4, samples);
  const Fit found = fit_model({}, samples, all);
  check_found(found, truth, &Muscle::start_W, 0.02);
  check_found(found, truth, &Muscle::time_constant_s, 0.01);
}

TEST(FitModel, FindsAMuscleWithMissingPositions) {
  Samples samples = random_steps(60.0, full_W, 5);
  record(other_muscle(), noise_m, 6, samples);
  for (std::size_t k = 700; k < 1400; ++k)
    samples.position_m[k] = NAN;
  check_found(fit_model({}, samples, all), other_muscle(), &Muscle::time_constant_s, 0.01);
}

TEST(FitModel, FindsEachEffect) {
  struct Case {
    Effect effect;
    double Muscle::*member;
    double value;
    double ratio;  ///< of the truth, within which it is found
  };
  for (const Case& c : {Case{Effect::drift, &Muscle::drift_m_per_s, -4e-5, 0.02},
                        Case{Effect::force, &Muscle::force_ratio, 2.5, 0.02},
                        Case{Effect::heat_transfer, &Muscle::transfer_ratio, 1.8, 0.02},
                        Case{Effect::heated_air, &Muscle::heated_ratio, 1.6, 0.02},
                        Case{Effect::creep, &Muscle::creep_ratio, 0.2, 0.05},
                        Case{Effect::lonely_stroke, &Muscle::lonely_stroke_m, 0.004, 0.05}}) {
    Samples samples = random_steps(120.0, full_W, 7);
    Muscle truth = other_muscle();
    truth.*c.member = c.value;
    truth.creep_s = 30.0;
    truth.lonely_stroke_W = 1.0;
    record(truth, noise_m, 8, samples);
    const Fit linear = fit_model({}, samples, all);
    check_found(refit(linear.muscle, Effects{c.effect}, samples, all), truth, c.member, c.ratio);
    CHECK_TEXT(linear.rms_m > 5.0 * noise_m, name(Effects{c.effect}).c_str());
  }
}

TEST(FitModel, FindsHysteresis) {
  Samples samples = random_steps(120.0, full_W, 9);
  Muscle truth = other_muscle();
  truth.play_ratio = 0.3;
  truth.play_range_W = 0.8;
  record(truth, noise_m, 10, samples);
  const Fit found = refit(fit_model({}, samples, all).muscle, {Effect::hysteresis}, samples, all);
  check_found(found, truth, &Muscle::play_ratio, 0.1);
  check_found(found, truth, &Muscle::play_range_W, 0.1);
}

TEST(FitModel, IgnoresSamplesAfterItsSpan) {
  Samples samples = random_steps(60.0, full_W, 11);
  record(other_muscle(), noise_m, 12, samples);
  const Fit before = fit_model({}, samples, {0.0, 30.0});
  for (std::size_t k = 1501; k < samples.size(); ++k)
    samples.position_m[k] += 0.002 * std::sin(static_cast<double>(k));
  // Scales are those of the whole recording, and so is the start of the search.
  const Fit after = fit_model({}, samples, {0.0, 30.0});
  DOUBLES_EQUAL(before.muscle.time_constant_s, after.muscle.time_constant_s, 2e-3);
}

TEST(FitModel, ReportsThatSlowHeatDoesNotDetermineMechanics) {
  Samples samples = random_steps(60.0, full_W, 13);
  for (std::size_t k = 0; k < samples.size(); ++k)
    samples.power_W[k] = 1.5 - 1.5 * std::cos(0.1 * samples.time_s(k));
  record(other_muscle(), 2e-4, 14, samples);
  const Fit found = fit_model({}, samples, all);
  const auto frequency =
      static_cast<Eigen::Index>(index_of(found, &Muscle::natural_frequency_rad_per_s));
  CHECK(std::sqrt(found.covariance(frequency, frequency)) > 0.3);
  check_found(found, other_muscle(), &Muscle::gain_m_per_W, 0.05);
}

TEST_GROUP(Physical){};

TEST(Physical, ThetaMatchesThePhysicalParameters) {
  const supercoil::control::PhysicalParameters paper;
  Muscle muscle;
  muscle.gain_m_per_W = paper.dc_gain_m_per_W();
  muscle.time_constant_s = paper.thermal_mass_J_per_K / paper.heat_transfer_W_per_K;
  muscle.natural_frequency_rad_per_s = std::sqrt(paper.stiffness_N_per_m / paper.moving_mass_kg);
  muscle.damping_ratio =
      0.5 * paper.damping_Ns_per_m / std::sqrt(paper.stiffness_N_per_m * paper.moving_mass_kg);
  const auto by_stiffness = physical_from(muscle, {});
  for (const auto& range : supercoil::control::physical_ranges) {
    const double expected = paper.*range.member;
    DOUBLES_EQUAL_TEXT(expected, by_stiffness.*range.member, 1e-9 * expected, range.name);
  }
  Assumed assumed;
  assumed.stiffness_N_per_m = 1.0;
  assumed.moving_mass_kg = paper.moving_mass_kg;
  DOUBLES_EQUAL(16.0, physical_from(muscle, assumed).stiffness_N_per_m, 1e-9);
}

TEST(Physical, ThetaAndItsDeviationsDoNotDependOnTheAssumedHeat) {
  Samples samples = random_steps(60.0, full_W, 15);
  record(other_muscle(), noise_m, 16, samples);
  const Fit found = fit_model({}, samples, all);
  Assumed heavy;
  heavy.thermal_mass_J_per_K = 1.0;
  const ThetaEstimate usual = theta_of(found, {});
  const ThetaEstimate other = theta_of(found, heavy);
  const auto truth = supercoil::control::theta_from(physical_from(other_muscle(), {}));
  for (int i = 0; i < 4; ++i) {
    DOUBLES_EQUAL(usual.theta[i], other.theta[i], 1e-9 * usual.theta[i]);
    DOUBLES_EQUAL(usual.deviation[i], other.deviation[i], 1e-4 * usual.deviation[i]);
    DOUBLES_EQUAL(truth[i], usual.theta[i], 3.0 * usual.deviation[i]);
    CHECK(usual.deviation[i] < 0.1 * usual.theta[i]);
  }
}
