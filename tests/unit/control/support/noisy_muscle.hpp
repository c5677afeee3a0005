// The paper's muscle under Eq. (18) and a noisy 16-bit sensor: what estimators are given.
#pragma once

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/estimation/least_squares.hpp"

#include "unit/control/support/muscle.hpp"

namespace supercoil::test {

class NoisyMuscle {
 public:
  explicit NoisyMuscle(unsigned seed, double noise_m = 10e-6)
      : source_(seed), noise_(0.0, noise_m) {}

  /// From this time on its stiffness is different.
  void soften_at(double time_s) { soft_from_s_ = time_s; }
  const control::PhysicalParameters& truth() const { return truth_; }
  double time_s() const { return step_s * static_cast<double>(ticks_); }

  /// Runs tick by tick until then; on_tick(position_m, power_W) gets what a board would measure.
  template <class OnTick>
  void run_until(double time_s, OnTick on_tick) {
    for (; ticks_ < std::lround(time_s / step_s); ++ticks_) {
      if (ticks_ == std::lround(soft_from_s_ / step_s)) {
        truth_.stiffness_N_per_m = 12.0;
        muscle_.change(truth_);
      }
      const double power_W = paper_power_W(this->time_s());
      muscle_.step(power_W);
      on_tick(std::nearbyint((muscle_.position_m() + noise_(source_)) / count_m) * count_m,
              power_W);
    }
  }

  static constexpr double step_s = 1e-3;

 private:
  static constexpr double count_m = 0.040 / 65536;

  boost::random::mt19937 source_;
  boost::random::normal_distribution<double> noise_;
  control::PhysicalParameters truth_;
  Muscle muscle_{truth_, step_s};
  double soft_from_s_ = 1e9;
  long ticks_ = 0;
};

/// Least squares on that muscle.
template <class Scalar>
class Learning {
 public:
  using Parameters = control::Vector<double, 5>;

  explicit Learning(unsigned seed, const control::LeastSquaresSettings& settings = {},
                    double noise_m = 10e-6)
      : muscle(seed, noise_m), estimator(settings, NoisyMuscle::step_s), settings_(settings) {}

  void run_until(double time_s) {
    muscle.run_until(time_s, [&](double position_m, double power_W) {
      estimator.step(Scalar(position_m / settings_.scale.dc_gain_m_per_W), Scalar(power_W));
    });
  }

  /// Relative errors of θ1…θ4, and the bias in W.
  Parameters off() const {
    const control::Theta truth =
        control::theta_from(muscle.truth()).cwiseQuotient(settings_.scale.nominal);
    Parameters result = estimator.parameters();
    result.template head<4>() = result.template head<4>().cwiseQuotient(truth).array() - 1.0;
    return result;
  }

  /// When θ1…θ4 come within a fraction of the truth for good: the last time, checked every 10 ms
  /// until the end, at which they were farther off.
  double outside_until(double part, double until_s) {
    double last_s = muscle.time_s();
    while (muscle.time_s() < until_s) {
      run_until(muscle.time_s() + 0.01);
      if (off().template head<4>().cwiseAbs().maxCoeff() > part) last_s = muscle.time_s();
    }
    return last_s;
  }

  NoisyMuscle muscle;
  control::LeastSquaresEstimator<Scalar> estimator;

 private:
  control::LeastSquaresSettings settings_;
};

}  // namespace supercoil::test
