// The fixed PID of adaptive_ff on muscles that are not the nominal one, sampled and delayed.
#include <complex>
#include <numbers>

#include <CppUTest/TestHarness.h>
#include <Eigen/Eigenvalues>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/actuator/state_space.hpp"
#include "supercoil/control/linear/discretize.hpp"
#include "supercoil/control/tracking/adaptive_feedforward.hpp"

using namespace supercoil::control;

namespace {

constexpr double loop_step_s = 1e-3;
/// 1.5 ms: one and a half ticks between the power's calculation and its acting.
constexpr double delay_s = 1.5e-3;

struct Margin {
  double spectral_radius;  ///< of the sampled loop; stable below 1
  double modulus;          ///< least |1 + L|: 1 over the largest amplification of noise
};

/// The muscle where bit i of a corner says which end of its span parameter i takes.
PhysicalParameters corner_of(int corner, double span) {
  PhysicalParameters p;
  for (std::size_t i = 0; i < physical_ranges.size(); ++i)
    p.*physical_ranges[i].member *= ((corner >> i) & 1) != 0 ? 1.0 + span : 1.0 - span;
  return p;
}

/// States: three of the muscle, the law's derivative filter, its last input, the integral, and the
/// last two powers wanted.
double spectral_radius(const PhysicalParameters& muscle) {
  constexpr int size = 9;
  const AdaptiveFeedforwardSettings s;
  const double pole = s.derivative_filter_rad_per_s;
  const auto system = state_space(muscle);
  const auto half = zero_order_hold<3, 2>(system.a, system.b, 0.5 * loop_step_s);
  const Companion<2> filter({pole * pole, 2.0 * pole, 1.0});
  const auto held = first_order_hold<2, 1>(filter.a, filter.b, loop_step_s);
  const Theta& nominal = s.scale.nominal;
  const double w = s.bandwidth_rad_per_s;

  using State = Vector<double, size>;
  const auto step = [&](const State& x) {
    State next;
    // In the first half of the tick the power before the last one still acts.
    Vector<double, 3> plant = half.transition * x.head<3>() + half.held.col(0) * x[8];
    plant = (half.transition * plant + half.held.col(0) * x[7]).eval();
    next.head<3>() = plant;
    next.segment<2>(3) =
        held.transition * x.segment<2>(3) + held.start * x[5] + held.end * plant[1];
    next[5] = plant[1];
    next[6] = x[6] - plant[1] * w * nominal[3] * loop_step_s;
    next[7] = next[6] - plant[1] * w * nominal[2] - next[4] * pole * pole * w * nominal[1];
    next[8] = x[7];
    return next;
  };
  Matrix<double, size> transition;
  for (int i = 0; i < size; ++i)
    transition.col(i) = step(State::Unit(i));
  return transition.eigenvalues().cwiseAbs().maxCoeff();
}

/// From the loop's frequency response, in continuous time with the delay and half a tick of hold.
double modulus(const PhysicalParameters& muscle) {
  using namespace std::complex_literals;
  const AdaptiveFeedforwardSettings s;
  const Theta& nominal = s.scale.nominal;
  const Theta theta = theta_from(muscle);
  double least = 1.0;
  constexpr double lowest = 0.01;
  constexpr double finer = 1.01;
  const double highest = std::numbers::pi / loop_step_s;
  const auto points = static_cast<int>(std::log(highest / lowest) / std::log(finer));
  for (int i = 0; i <= points; ++i) {
    const double omega = lowest * std::pow(finer, i);
    const std::complex<double> p = 1i * omega;
    const auto lag = p / s.derivative_filter_rad_per_s + 1.0;
    const auto law =
        s.bandwidth_rad_per_s * (nominal[2] + nominal[3] / p + nominal[1] * p / (lag * lag));
    const auto plant =
        ((theta[0] * muscle.moving_mass_kg * p + theta[1]) * p + theta[2]) * p + theta[3];
    least = std::fmin(least,
                      std::abs(1.0 + law / plant * std::exp(-p * (delay_s + 0.5 * loop_step_s))));
  }
  return least;
}

struct Worst {
  int unstable = 0;
  int corner = 0;
  Margin margin{.spectral_radius = 0.0, .modulus = 1.0};
};

Worst worst_corner(double span) {
  Worst worst;
  for (int corner = 0; corner < 64; ++corner) {
    const PhysicalParameters muscle = corner_of(corner, span);
    const Margin margin{spectral_radius(muscle), modulus(muscle)};
    if (margin.spectral_radius >= 1.0) ++worst.unstable;
    if (margin.modulus < worst.margin.modulus) {
      worst.margin = margin;
      worst.corner = corner;
    }
  }
  return worst;
}

}  // namespace

TEST_GROUP(AdaptiveFeedforwardMargin){};

TEST(AdaptiveFeedforwardMargin, HoldsAtAllCornersOfPlusMinus20Percent) {
  const Worst worst = worst_corner(0.2);
  std::string text = "worst corner:";
  for (std::size_t i = 0; i < physical_ranges.size(); ++i)
    text += std::string(((worst.corner >> i) & 1) != 0 ? " +" : " -") + physical_ranges[i].name;
  text += "; spectral radius " + std::to_string(worst.margin.spectral_radius) + ", least |1 + L| " +
          std::to_string(worst.margin.modulus);
  UT_PRINT(text.c_str());
  LONGS_EQUAL(0, worst.unstable);
  CHECK(worst.margin.modulus > 0.05);
}

TEST(AdaptiveFeedforwardMargin, DoesNotHoldAtPlusMinus50Percent) {
  const Worst worst = worst_corner(0.5);
  UT_PRINT(StringFromFormat("%d of 64 corners are unstable", worst.unstable).asCharString());
  CHECK(worst.unstable > 0);
}

TEST(AdaptiveFeedforwardMargin, TheNominalMuscleHasRoom) {
  const PhysicalParameters nominal;
  CHECK(spectral_radius(nominal) < 1.0);
  CHECK(modulus(nominal) > 0.4);
}
