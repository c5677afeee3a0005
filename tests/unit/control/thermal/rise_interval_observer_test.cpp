#include "supercoil/control/thermal/rise_interval_observer.hpp"

#include <array>
#include <cmath>

#include <CppUTest/TestHarness.h>
#include <rapidcheck.h>

#include "unit/control/support/generators.hpp"

using namespace supercoil;
using control::IntervalObserver;
using control::RiseIntervalObserver;
using control::ThermalBounds;
using control::TransferSpan;

namespace {

constexpr ThermalBounds wide_bounds{0.12, 0.20, 0.03, 0.25};

double any_between(double low, double high) {
  return *test::reals(low, high);
}

/// A muscle whose heat transfer grows with its rise, by at most the cube root.
struct GrowingMuscle {
  double mass = any_between(wide_bounds.min_mass_J_per_K, wide_bounds.max_mass_J_per_K);
  double at_K = any_between(10.0, 100.0);
  double transfer = any_between(0.06, 0.12);  ///< at the rise at_K
  double power = any_between(0.0, 1.0 / 3.0);
  double rise_K = 0.0;

  double transfer_at(double rise) const {
    // Stays within the configured bounds even when cold.
    return std::fmax(wide_bounds.min_transfer_W_per_K, transfer * std::pow(rise / at_K, power));
  }
  void step(double power_W, double step_s) {
    constexpr int substeps = 50;
    for (int i = 0; i < substeps; ++i)
      rise_K += (power_W - transfer_at(rise_K) * rise_K) / mass * step_s / substeps;
  }
};

}  // namespace

TEST_GROUP(RiseIntervalObserver){};

TEST(RiseIntervalObserver, ContainsAMuscleWhoseHeatTransferGrowsWithItsRise) {
  CHECK(rc::check("random muscles, known at a rise, under random powers", [] {
    const double step_s = *rc::gen::element(1e-3, 1e-2, 0.2);
    GrowingMuscle muscle;
    RiseIntervalObserver observer(wide_bounds, step_s);
    const double from_K = any_between(0.7, 1.0) * muscle.at_K;
    const double to_K = any_between(1.0, 1.5) * muscle.at_K;
    const std::array<TransferSpan, 1> spans{
        {{0.97 * muscle.transfer_at(from_K), 1.03 * muscle.transfer_at(to_K), from_K, to_K}}};
    observer.set(wide_bounds, spans);
    for (int stretch = 0; stretch < 10; ++stretch) {
      const double power_W = *rc::gen::element(0.0, any_between(0.0, 12.0), 12.0);
      for (int tick = 0; tick < 60; ++tick) {
        muscle.step(power_W, step_s);
        observer.step(power_W, power_W);
        // The truth is integrated in Euler steps, which are not exact.
        const double allowed_K = 1e-6 + 2e-3 * muscle.rise_K;
        RC_ASSERT(observer.min_K() <= muscle.rise_K + allowed_K);
        RC_ASSERT(observer.max_K() >= muscle.rise_K - allowed_K);
      }
    }
  }));
}

/// Bounds on mass and heat transfer alone would allow 0.20 / 0.03 = 6.7 s.
TEST(RiseIntervalObserver, ContainsAMuscleNoSlowerThanTheSlowestTimeConstant) {
  ThermalBounds bounds = wide_bounds;
  bounds.max_time_constant_s = 4.5;
  CHECK(rc::check("random muscles of time constants up to 4.5 s, under random powers", [&] {
    const double step_s = *rc::gen::element(1e-3, 1e-2, 0.2);
    const double mass = any_between(bounds.min_mass_J_per_K, bounds.max_mass_J_per_K);
    const double transfer =
        any_between(std::fmax(bounds.min_transfer_W_per_K, mass / bounds.max_time_constant_s),
                    bounds.max_transfer_W_per_K);
    const double stays = std::exp(-transfer / mass * step_s);
    double rise_K = any_between(0.0, 100.0);
    RiseIntervalObserver observer(bounds, step_s);
    observer.reset(100.0);
    for (int stretch = 0; stretch < 10; ++stretch) {
      const double power_W = *rc::gen::element(0.0, any_between(0.0, 12.0));
      for (int tick = 0; tick < 60; ++tick) {
        rise_K = power_W / transfer + (rise_K - power_W / transfer) * stays;
        observer.step(power_W, power_W);
        RC_ASSERT(observer.min_K() <= rise_K + 1e-9);
        RC_ASSERT(observer.max_K() >= rise_K - 1e-9);
      }
    }
  }));
}

TEST(RiseIntervalObserver, CoolsNoSlowerThanTheSlowestTimeConstant) {
  ThermalBounds bounds = wide_bounds;
  bounds.max_time_constant_s = 4.5;
  RiseIntervalObserver observer(bounds, 1e-2);
  observer.reset(100.0);
  for (int tick = 0; tick < 450; ++tick)
    observer.step(0.0, 0.0);
  DOUBLES_EQUAL(100.0 / std::exp(1.0), observer.max_K(), 1e-6);
}

TEST(RiseIntervalObserver, WithoutSpansMatchesThePlainObserverToTheBit) {
  CHECK(rc::check("any power", [] {
    RiseIntervalObserver observer(wide_bounds, 0.01);
    IntervalObserver plain(wide_bounds, 0.01);
    observer.reset(150.0);
    plain.reset(150.0);
    for (int tick = 0; tick < 300; ++tick) {
      const double power_W = any_between(0.0, 15.0);
      observer.step(0.9 * power_W, power_W);
      plain.step(0.9 * power_W, power_W);
      RC_ASSERT(observer.min_K() == plain.min_K());
      RC_ASSERT(observer.max_K() == plain.max_K());
    }
  }));
}

TEST(RiseIntervalObserver, IsNeverWiderThanWithoutSpans) {
  CHECK(rc::check("any span, also one that contradicts the bounds", [] {
    const double min = any_between(0.0, 0.4);
    const double from_K = any_between(1.0, 100.0);
    const std::array<TransferSpan, 1> spans{
        {{min, min * any_between(1.0, 2.0), from_K, from_K * any_between(1.0, 2.0)}}};
    RiseIntervalObserver observer(wide_bounds, 0.01);
    RiseIntervalObserver plain(wide_bounds, 0.01);
    observer.set(wide_bounds, spans);
    for (int tick = 0; tick < 600; ++tick) {
      observer.step(3.0, 4.0);
      plain.step(3.0, 4.0);
      RC_ASSERT(observer.min_K() >= plain.min_K());
      RC_ASSERT(observer.max_K() <= plain.max_K());
    }
  }));
}

TEST(RiseIntervalObserver, KeepsItsStateWhenItsBoundsAreReplaced) {
  RiseIntervalObserver observer(wide_bounds, 0.01);
  observer.reset(120.0);
  const std::array<TransferSpan, 1> spans{{{0.08, 0.10, 20.0, 40.0}}};
  observer.set(wide_bounds, spans);
  DOUBLES_EQUAL(120.0, observer.max_K(), 0.0);
  for (int tick = 0; tick < 6000; ++tick)
    observer.step(2.4, 2.4);
  DOUBLES_EQUAL(30.0, observer.max_K(), 1e-6);
  DOUBLES_EQUAL(24.0, observer.min_K(), 1e-6);
}

TEST(RiseIntervalObserver, BoundsWidenOutsideTheRisesOfASpan) {
  const TransferSpan span{0.08, 0.10, 40.0, 60.0};
  DOUBLES_EQUAL(0.04, span.min_at(5.0), 1e-12);
  DOUBLES_EQUAL(0.08, span.min_at(100.0), 0.0);
  DOUBLES_EQUAL(0.10, span.max_at(5.0), 0.0);
  DOUBLES_EQUAL(0.20, span.max_at(480.0), 1e-12);
}
