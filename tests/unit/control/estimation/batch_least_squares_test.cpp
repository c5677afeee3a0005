#include "supercoil/control/estimation/batch_least_squares.hpp"

#include <cmath>
#include <random>

#include <CppUTest/TestHarness.h>

#include "unit/control/support/muscle.hpp"

using namespace supercoil::control;

namespace {

constexpr double block_s = 8.0;

/// Every parameter of the belief is as far off as the board allows.
PhysicalParameters half_wrong_guess() {
  PhysicalParameters guess;
  guess.thermal_mass_J_per_K *= 1.5;
  guess.heat_transfer_W_per_K *= 0.5;
  guess.stiffness_N_per_m *= 1.5;
  guess.damping_Ns_per_m *= 0.5;
  return guess;
}

/// The paper's muscle under a power that steps and swings.
struct PowerSteps {
  double noise_rms_m = 10e-6;
  double bias_W = 0.0;        ///< added to the power that the fit sees
  double softens_at_s = 1e6;  ///< to 11 N/m
  double scale = 1.0;         ///< of the power
  std::size_t blocks = 6;

  std::optional<BatchLeastSquares::Fit> run(unsigned seed = 1) const {
    return experiment(seed).fit();
  }
  BatchLeastSquares experiment(unsigned seed = 1, double restart_at_s = 1e6) const {
    constexpr double step_s = 1e-3;
    BatchLeastSquares fit(half_wrong_guess(), step_s);
    fit.start(0.0);
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0.0, noise_rms_m);
    PhysicalParameters parameters;
    supercoil::test::Muscle muscle(parameters, step_s);
    double power_W = 0.0;
    const double duration_s = block_s * static_cast<double>(1 + blocks);
    for (int k = 0; k * step_s < duration_s; ++k) {
      const double time_s = k * step_s;
      if (time_s >= softens_at_s && parameters.stiffness_N_per_m != 11.0) {
        parameters.stiffness_N_per_m = 11.0;
        muscle.change(parameters);
      }
      muscle.step(power_W);
      if (std::abs(time_s - restart_at_s) < 0.5 * step_s) fit.restart();
      // The filters settle during the first block of a run.
      const double from_s = time_s < restart_at_s ? block_s : restart_at_s;
      fit.step(muscle.position_m() + noise(random), power_W + bias_W,
               time_s < from_s ? std::optional<std::size_t>()
                               : static_cast<std::size_t>((time_s - from_s) / block_s));
      const bool heats = std::fmod(time_s, block_s) < 0.4 * block_s;
      power_W = scale *
                ((heats ? 3.5 : 0.4) +
                 0.1 * (std::sin(4.1 * time_s) + std::sin(9.3 * time_s) + std::sin(21.7 * time_s)));
    }
    return fit;
  }
};

Theta paper_theta() {
  return theta_from(PhysicalParameters{});
}

}  // namespace

TEST_GROUP(BatchLeastSquares){};

TEST(BatchLeastSquares, FindsAMuscleFromAWrongInitialGuess) {
  const auto fit = PowerSteps{}.run();
  CHECK(fit.has_value());
  for (int i = 0; i < 4; ++i) {
    DOUBLES_EQUAL(paper_theta()[i], fit->theta[i], 0.02 * paper_theta()[i]);
    CHECK(fit->deviation[i] < 0.02);
    CHECK(fit->holdout_difference[i] < 0.03);
  }
  DOUBLES_EQUAL(0.0, fit->bias_W, 1e-3);
  CHECK(fit->unexplained_ratio < 1e-4);
}

/// Only noise remains unexplained, as in the fit's own experiment; a bias does not count.
TEST(BatchLeastSquares, ValidatesAMuscleOnAnExperimentNotUsedForTheFit) {
  for (const double bias_W : {0.0, 0.3}) {
    const PowerSteps steps{.bias_W = bias_W};
    BatchLeastSquares fit = steps.experiment();
    const BatchLeastSquares::Sums before = fit.experiment();
    CHECK_COMPARE(fit.unexplained_ratio(before, paper_theta()), <, 1e-4);
    Theta wrong = paper_theta();
    wrong[3] *= 1.5;  // half of the power that holds it
    const double unexplained = fit.unexplained_ratio(before, wrong);
    CHECK_COMPARE(unexplained, >, 0.01);
    // Whatever has been fitted since.
    fit.start(0.0);
    DOUBLES_EQUAL(unexplained, fit.unexplained_ratio(before, wrong), 1e-15);
  }
}

/// The restart comes in the middle of a stroke: the filters need not settle again.
TEST(BatchLeastSquares, RestartingMidExperimentFindsTheSameMuscle) {
  const BatchLeastSquares restarted =
      PowerSteps{.noise_rms_m = 0.0, .blocks = 14}.experiment(1, 7.6 * block_s);
  CHECK_EQUAL(8U, restarted.blocks());
  const auto fit = restarted.fit();
  CHECK(fit.has_value());
  for (int i = 0; i < 4; ++i)
    DOUBLES_EQUAL(paper_theta()[i], fit->theta[i], 0.005 * paper_theta()[i]);
}

TEST(BatchLeastSquares, FindsAConstantBiasOfThePower) {
  const auto fit = PowerSteps{.bias_W = 0.3}.run();
  DOUBLES_EQUAL(0.3, fit->bias_W, 0.003);
  for (int i = 1; i < 4; ++i)
    DOUBLES_EQUAL(paper_theta()[i], fit->theta[i], 0.01 * paper_theta()[i]);
}

/// An ordinary fit to the same samples finds θ2 too small, because its regressors carry the noise.
TEST(BatchLeastSquares, NoiseWidensTheResultWithoutBias) {
  double mean = 0.0;
  double deviation = 0.0;
  constexpr int runs = 10;
  for (unsigned seed = 1; seed <= runs; ++seed) {
    const auto fit = PowerSteps{.noise_rms_m = 2e-3}.run(seed);
    mean += fit->theta[1] / paper_theta()[1] / runs;
    deviation += fit->deviation[1] / runs;
  }
  const double quiet = PowerSteps{}.run()->deviation[1];
  CHECK(deviation > 20.0 * quiet);
  DOUBLES_EQUAL(1.0, mean, 3.0 * deviation / std::sqrt(static_cast<double>(runs)));
  CHECK(deviation < 0.1);
}

TEST(BatchLeastSquares, ReportedDeviationsMatchTheErrors) {
  Theta squares = Theta::Zero();
  Theta reported = Theta::Zero();
  constexpr int runs = 20;
  for (unsigned seed = 1; seed <= runs; ++seed) {
    const auto fit = PowerSteps{.noise_rms_m = 0.3e-3}.run(seed);
    squares += (fit->theta.cwiseQuotient(paper_theta()) - Theta::Ones()).cwiseAbs2() / runs;
    reported += fit->deviation.cwiseAbs2() / runs;
  }
  for (int i = 0; i < 4; ++i) {
    const double ratio = std::sqrt(reported[i] / squares[i]);
    CHECK(ratio > 0.6);
    CHECK(ratio < 1.8);
  }
}

TEST(BatchLeastSquares, AMuscleThatChangesMidExperimentIsNotExplained) {
  const auto fit = PowerSteps{.softens_at_s = 42.0}.run();
  CHECK(fit->unexplained_ratio > 0.06);
  CHECK(fit->holdout_difference[3] > 0.15);
}

TEST(BatchLeastSquares, TooFewBlocksGiveNoFit) {
  CHECK_FALSE(PowerSteps{.blocks = BatchLeastSquares::min_blocks - 1}.run().has_value());
}

TEST(BatchLeastSquares, WithoutMotionThereIsNoFit) {
  const auto fit = PowerSteps{.scale = 1e-6}.run();
  CHECK(!fit || fit->deviation[3] > 0.1 || fit->unexplained_ratio > 0.06);
}
