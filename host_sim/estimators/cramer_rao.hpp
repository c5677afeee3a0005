// The best possible accuracy of the muscle's parameters from the sensor's data.
#pragma once

#include <cstdint>
#include <functional>

#include "estimators/muscle_state.hpp"

namespace supercoil::host_sim::estimators {

/// What is unknown in addition to θ.
struct Unknown {
  bool motion = true;  ///< position, velocity and acceleration at the beginning
  bool bias = true;    ///< constant, of the power
};

/// An experiment on a muscle whose position is measured with white noise.
struct Experiment {
  State begin;  ///< the muscle and its motion at begin_s
  double begin_s = 0.0;
  double moving_mass_kg = control::PhysicalParameters{}.moving_mass_kg;
  std::function<double(double time_s)> power_W;
  double noise_density_m2_s = 1e-13;  ///< rms² · sampling period: 10 µm at 1 kHz
};

/// The Cramér–Rao bound: the smallest relative standard deviation that an unbiased estimate of
/// θ1…θ4 can have from the measurements. The Fisher information is summed from the derivatives of
/// the muscle's exact motion with respect to its parameters and its first state.
class CramerRaoBound {
 public:
  CramerRaoBound(const Experiment& experiment, const Unknown& unknown);

  /// From the measurements between begin_s and this time, which is later than in any call before.
  /// Infinite while they are too few.
  control::Theta until(double time_s);

 private:
  void step();

  /// The sensitivities are smooth: 5 ms instead of the sensor's 1 ms changes no printed digit.
  static constexpr double step_s = 5e-3;

  Experiment experiment_;
  Unknown unknown_;
  std::int64_t steps_ = 0;
  State state_;
  Covariance sensitivity_ = Covariance::Identity();  ///< of the state now to that at begin_s
  Covariance information_ = Covariance::Zero();
};

}  // namespace supercoil::host_sim::estimators
