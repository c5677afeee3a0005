#include "supercoil/control/estimation/cooling_fit.hpp"

#include <cmath>
#include <random>

#include <CppUTest/TestHarness.h>

#include "modes/excitation.hpp"
#include "plant/plant.hpp"
#include "plant/presets.hpp"

using namespace supercoil;
using namespace supercoil::host_sim;

namespace {

constexpr double fit_step_s = 1e-3;
constexpr double max_travel_m = 0.040;
constexpr double max_s = 1500.0;

modes::Excitation begun() {
  modes::Excitation excitation({max_travel_m, fit_step_s});
  excitation.start(0.0);
  return excitation;
}

/// ψ/η of a muscle at its mean rise during identification.
struct Identified {
  double found_s = NAN;  ///< NaN: nothing was found
  double true_s = 0.0;
};

/// As in docs/muscles.md.
double transfer_W_per_K(const PresetMuscle& muscle, double rise_K) {
  HeatTransfer heat;
  heat.set(muscle.parameters, muscle.effects, fit_step_s);
  return heat.conductance_W_per_K(rise_K);
}

Identified identify_preset(MusclePreset preset, double cooling_ratio, double max_W) {
  PresetMuscle muscle = preset_muscle(preset);
  const control::PhysicalParameters believed = muscle.parameters;
  const double believed_s = believed.thermal_mass_J_per_K / believed.heat_transfer_W_per_K;
  muscle.parameters.heat_transfer_W_per_K *= cooling_ratio;
  Plant plant(muscle.parameters, muscle.effects, fit_step_s);
  control::CoolingFit fit({0.34 * believed_s, 3.0 * believed_s, max_W}, fit_step_s);
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise_m(0.0, 10e-6);
  double power_W = 0.0;
  double sum_K = 0.0;
  long ticks = 0;
  modes::Excitation excitation = begun();
  for (; !excitation.done() && static_cast<double>(ticks) * fit_step_s < max_s; ++ticks) {
    const double measured_m = plant.position_m() + noise_m(random);
    fit.step(measured_m, power_W);
    power_W = excitation.step(measured_m, max_W);
    plant.step(power_W);
    sum_K += plant.temperature_rise_K();
  }
  const double mean_K = sum_K / static_cast<double>(ticks);
  Identified result;
  if (const auto found = fit.found()) result.found_s = found->time_constant_s;
  result.true_s = muscle.parameters.thermal_mass_J_per_K / transfer_W_per_K(muscle, mean_K);
  return result;
}

}  // namespace

TEST_GROUP(CoolingFit){};

TEST(CoolingFit, FindsTheTimeConstantWhereHeatTransferDoesNotDependOnTheRise) {
  // In b and c the force grows with temperature, by up to six times, and b softens.
  struct Case {
    MusclePreset preset;
    double max_W;
  };
  for (const Case& c :
       {Case{MusclePreset::paper, 4.5}, Case{MusclePreset::b, 2.15}, Case{MusclePreset::c, 3.1}}) {
    for (const double cooling : {0.5, 1.0, 2.0}) {
      const Identified e = identify_preset(c.preset, cooling, c.max_W * std::fmin(1.0, cooling));
      DOUBLES_EQUAL(1.0, e.found_s / e.true_s, 0.02);
    }
  }
}

TEST(CoolingFit, OnARealMuscleErrsByAtMostItsModelErrorOrFindsNothing) {
  int found = 0;
  for (const MusclePreset preset : {MusclePreset::real, MusclePreset::real_hard}) {
    for (const double cooling : {0.5, 1.0, 2.0}) {
      for (const double max_W : {2.25, 4.5}) {
        const Identified e = identify_preset(preset, cooling, max_W * std::fmin(1.0, cooling));
        if (std::isnan(e.found_s)) continue;
        ++found;
        CHECK_COMPARE(e.found_s / e.true_s, <, 1.25);
        CHECK_COMPARE(e.found_s / e.true_s, >, 1.0 / 1.25);
      }
    }
  }
  CHECK_COMPARE(found, >=, 8);
}

TEST(CoolingFit, FindsNothingWhenMotionDoesNotFollowThePower) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise_m(0.0, 10e-6);
  for (const double drift_m : {0.0, 1e-5}) {
    control::CoolingFit fit({0.5, 6.0, 4.5}, fit_step_s);
    double walk_m = 0.0;
    for (int k = 0; k < 60'000; ++k) {
      walk_m += drift_m * noise_m(random) / 10e-6;
      const double power_W = k % 9000 < 4000 ? 4.0 : 0.1;
      fit.step(walk_m + noise_m(random), power_W);
    }
    CHECK_FALSE(fit.found().has_value());
  }
}

TEST(CoolingFit, FindsNothingInTooShortATimeAndRestarts) {
  const control::PhysicalParameters muscle;
  Plant plant(muscle, {}, fit_step_s);
  control::CoolingFit fit({0.5, 6.0, 4.5}, fit_step_s);
  modes::Excitation excitation = begun();
  const auto drive = [&](double time_s) {
    for (long k = 0; k < std::lround(time_s / fit_step_s); ++k) {
      const double power_W = excitation.step(plant.position_m(), 4.5);
      plant.step(power_W);
      fit.step(plant.position_m(), power_W);
    }
  };
  drive(20.0);
  CHECK_FALSE(fit.found().has_value());
  drive(40.0);
  CHECK(fit.found().has_value());
  fit.start();
  CHECK_FALSE(fit.found().has_value());
}
