// The model's motion against the equations, integrated in steps of 0.1 ms.
#include <algorithm>
#include <array>
#include <cmath>

#include <CppUTest/TestHarness.h>

#include "unit/identification/support/simulated.hpp"

namespace {

using namespace supercoil::identification;
using namespace supercoil::identification::test;

/// Euler's method for the equations in docs/recordings.md, for one muscle.
class Equations {
 public:
  Equations(const Muscle& muscle, double max_W)
      : m_(muscle), full_W_(max_W), u_(muscle.start_W), slow_(force()) {
    plays_.fill(u_);
    x_ = force() + m_.start_offset_m;
    v_ = m_.start_m_per_s;
    slow_ = x_;
  }

  double position_m() const {
    const double rest = m_.rest_m + m_.drift_m_per_s * time_s_ + m_.heat_drift_m_per_J * heat_J_ -
                        m_.lonely_stroke_m * std::min(1.0, hottest_ / m_.lonely_stroke_W);
    return rest + (1.0 - m_.creep_ratio) * x_ + m_.creep_ratio * slow_;
  }

  void step(double power_W, double dt_s) {
    const double w = m_.natural_frequency_rad_per_s;
    const double acceleration = w * w * (force() - x_) - 2.0 * m_.damping_ratio * w * v_;
    double h = 1.0 + (m_.transfer_ratio - 1.0) * u_ / full_W_;
    if (power_W > 0.0) h *= m_.heated_ratio;
    heat_J_ += u_ * dt_s;
    slow_ += (x_ - slow_) * dt_s / m_.creep_s;
    x_ += v_ * dt_s;
    v_ += acceleration * dt_s;
    u_ += (power_W - h * u_) * dt_s / m_.time_constant_s;
    hottest_ = std::max(hottest_, u_);
    for (std::size_t i = 0; i < plays_.size(); ++i) {
      const double half = m_.play_range_W * static_cast<double>(i + 1) / 10.0;
      plays_[i] = std::max(u_ - half, std::min(u_ + half, plays_[i]));
    }
    time_s_ += dt_s;
  }

 private:
  double force() const {
    double mean = 0.0;
    for (const double play : plays_)
      mean += play / 5.0;
    const double u = (1.0 - m_.play_ratio) * u_ + m_.play_ratio * mean;
    return m_.gain_m_per_W * (u + 0.5 * (m_.force_ratio - 1.0) * u * u / full_W_);
  }

  const Muscle& m_;
  double full_W_;
  double u_;
  double x_ = 0.0;
  double v_ = 0.0;
  double slow_;
  double heat_J_ = 0.0;
  double hottest_ = 0.0;
  double time_s_ = 0.0;
  std::array<double, 5> plays_{};
};

/// The largest difference relative to the stroke, in 40 s of steps of up to 2 W.
double difference(const Muscle& muscle) {
  Samples samples = random_steps(40.0, 2.0, 3);
  const auto predicted = motion(muscle, samples, 2.0, samples.size());
  Equations equations(muscle, 2.0);
  constexpr int steps = 200;
  double apart_m = 0.0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    apart_m = std::max(apart_m, std::abs(predicted[k] - equations.position_m()));
    for (int i = 0; i < steps; ++i)
      equations.step(samples.power_W[k], samples.step_s / steps);
  }
  const auto [lowest, highest] = std::minmax_element(predicted.begin(), predicted.end());
  return apart_m / (*highest - *lowest);
}

}  // namespace

TEST_GROUP(Motion){};

TEST(Motion, OfALinearMuscleFollowsTheEquations) {
  DOUBLES_EQUAL(0.0, difference(other_muscle()), 1e-3);
}

TEST(Motion, OfAQuickMuscleFollowsTheEquations) {
  Muscle quick = other_muscle();
  quick.time_constant_s = 0.1;
  quick.natural_frequency_rad_per_s = 30.0;
  quick.damping_ratio = 0.8;
  DOUBLES_EQUAL(0.0, difference(quick), 1e-3);
}

TEST(Motion, StartsWarmAndMovingAtTheGivenState) {
  Muscle muscle = other_muscle();
  muscle.start_W = 1.0;
  muscle.start_offset_m = 0.002;
  muscle.start_m_per_s = -0.01;
  DOUBLES_EQUAL(0.0, difference(muscle), 1e-3);
}

TEST(Motion, OfEachEffectFollowsTheEquations) {
  struct Effect {
    void (*set)(Muscle&);
    double allowed;  ///< relative to the stroke
  };
  constexpr std::array<Effect, 6> effects{{
      {[](Muscle& m) {
         m.drift_m_per_s = 1e-4;
         m.heat_drift_m_per_J = -1e-4;
       },
       1e-3},
      {[](Muscle& m) { m.force_ratio = 3.0; }, 1e-3},
      {[](Muscle& m) {
         m.transfer_ratio = 2.0;
         m.heated_ratio = 1.5;
       },
       2e-3},
      {[](Muscle& m) {
         m.play_ratio = 0.5;
         m.play_range_W = 0.6;
       },
       1e-3},
      {[](Muscle& m) {
         m.creep_ratio = 0.3;
         m.creep_s = 6.0;
       },
       2e-3},
      {[](Muscle& m) {
         m.lonely_stroke_m = 0.004;
         m.lonely_stroke_W = 0.8;
       },
       1e-3},
  }};
  for (const Effect& effect : effects) {
    Muscle muscle = other_muscle();
    effect.set(muscle);
    DOUBLES_EQUAL(0.0, difference(muscle), effect.allowed);
  }
}
