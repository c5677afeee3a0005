#include "plant/bundle_plant.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <CppUTest/TestHarness.h>

#include "unit/host_sim/plant/support.hpp"

using namespace supercoil;
using host_sim::BundledMuscle;
using host_sim::BundlePlant;
using host_sim::NonlinearPlant;

namespace {

constexpr double bundle_tick_s = 1e-3;

BundledMuscle real_in_bundle() {
  return {host_sim::preset_muscle(host_sim::MusclePreset::real).parameters, test::real_muscle()};
}

void run_bundle(BundlePlant& plant, const std::vector<double>& power_W, double time_s,
                double load_N = 0.0) {
  for (long i = 0; i < std::lround(time_s / bundle_tick_s); ++i)
    plant.step(power_W, load_N);
}

}  // namespace

TEST_GROUP(BundlePlant){};

TEST(BundlePlant, OfOneMuscleMatchesThatMuscle) {
  const BundledMuscle one = real_in_bundle();
  BundlePlant bundle({one}, bundle_tick_s);
  NonlinearPlant alone(one.parameters, one.effects, bundle_tick_s);
  for (int i = 0; i < 20'000; ++i) {
    const std::array power_W{1.5 + std::sin(1e-3 * i)};
    bundle.step(power_W, 0.1);
    alone.step(power_W[0], 0.1);
  }
  DOUBLES_EQUAL(alone.temperature_rise_K(), bundle.temperature_rise_K(0), 0.0);
  // The load is subtracted at a different place in the sum.
  DOUBLES_EQUAL(alone.position_m(), bundle.position_m(), 1e-12);
  DOUBLES_EQUAL(alone.velocity_m_per_s(), bundle.velocity_m_per_s(), 1e-12);
}

/// Three muscles side by side lift three times the load as one muscle lifts it.
TEST(BundlePlant, ThreeEqualMusclesMoveThreeTimesTheLoadAsOneDoes) {
  const BundledMuscle one = real_in_bundle();
  BundledMuscle shared = one;
  shared.parameters.moving_mass_kg *= 3.0;
  shared.effects.hanging_mass_kg *= 3.0;
  BundlePlant bundle({shared, shared, shared}, bundle_tick_s);
  BundlePlant alone({one}, bundle_tick_s);
  for (const double power_W : {2.0, 0.5, 3.0}) {
    run_bundle(bundle, {power_W, power_W, power_W}, 3.0, 0.3);
    run_bundle(alone, {power_W}, 3.0, 0.1);
    DOUBLES_EQUAL(alone.position_m(), bundle.position_m(), 1e-10);
    DOUBLES_EQUAL(alone.temperature_rise_K(0), bundle.temperature_rise_K(2), 0.0);
  }
}

/// Linear muscles settle where Σ force = Σ stiffness · position + load.
TEST(BundlePlant, UnequalMusclesSettleWhereTheirForcesMeetTheLoad) {
  std::vector<BundledMuscle> muscles(3);
  muscles[1].parameters.heat_transfer_W_per_K *= 1.5;
  muscles[2].parameters.force_per_kelvin_N_per_K *= 0.5;
  muscles[2].parameters.stiffness_N_per_m *= 1.2;
  BundlePlant bundle(muscles, bundle_tick_s);
  const std::vector<double> power_W{1.0, 2.0, 3.0};
  run_bundle(bundle, power_W, 60.0, 0.05);
  double force_N = -0.05;
  double stiffness_N_per_m = 0.0;
  for (std::size_t i = 0; i < muscles.size(); ++i) {
    const control::PhysicalParameters& p = muscles[i].parameters;
    const double rise_K = power_W[i] / p.heat_transfer_W_per_K;
    DOUBLES_EQUAL(rise_K, bundle.temperature_rise_K(i), 1e-6 * rise_K);
    force_N += p.force_per_kelvin_N_per_K * rise_K;
    stiffness_N_per_m += p.stiffness_N_per_m;
  }
  DOUBLES_EQUAL(force_N / stiffness_N_per_m, bundle.position_m(), 1e-7);
}

TEST(BundlePlant, ALostMuscleStillPullsAsASpring) {
  const std::vector<BundledMuscle> muscles(2);
  BundlePlant whole(muscles, bundle_tick_s);
  BundlePlant half(muscles, bundle_tick_s);
  run_bundle(whole, {2.0, 2.0}, 60.0);
  run_bundle(half, {2.0, 0.0}, 60.0);
  DOUBLES_EQUAL(0.5 * whole.position_m(), half.position_m(), 1e-6);
  DOUBLES_EQUAL(0.0, half.temperature_rise_K(1), 0.0);
  CHECK_COMPARE(half.peak_temperature_rise_K(0), >, 20.0);
}
