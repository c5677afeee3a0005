// A mass on a spring and a damper, one step at a time.
#pragma once

#include <array>

#include "supercoil/control/actuator/parameters.hpp"

namespace supercoil::host_sim {

struct Motion {
  double position_m = 0.0;
  double velocity_m_per_s = 0.0;
};

/// Spring and force that act on the mass over a step, both linear in time.
struct Drive {
  double stiffness_N_per_m;
  double stiffness_end_N_per_m;
  double force_N;
  double force_end_N;
};

/// m v̇ = f(t) − c v − K x: exact while K is constant and f a straight line. K is taken at the
/// middle of the step.
class Mechanics {
 public:
  void set(const control::PhysicalParameters& parameters, double max_stiffness_N_per_m,
           double step_s);

  Motion step(const Motion& from, const Drive& drive) const {
    const double k = 0.5 * (drive.stiffness_N_per_m + drive.stiffness_end_N_per_m) * per_mass_;
    const auto [once, twice] = smooth_ ? integrals(k) : closed_integrals(k);
    const double u = drive.force_N * per_mass_;
    const double slope = (drive.force_end_N - drive.force_N) * per_mass_step_;
    // The impulse response's own equation, integrated twice and once.
    const double response = step_s_ - damping_ * once - k * twice;
    const double rate = 1.0 - damping_ * response - k * once;
    return {from.position_m * (1.0 - k * once) +
                (from.velocity_m_per_s * response + (u * once + slope * twice)),
            from.velocity_m_per_s * rate + ((u - k * from.position_m) * response + slope * once)};
  }

  double step_s() const { return step_s_; }

 private:
  struct Integrals {
    double once;   ///< of the impulse response over the step
    double twice;  ///< of that integral
  };
  /// Power series in K, which needs a short step.
  Integrals integrals(double k) const {
    return {once_[0] + k * (once_[1] + k * once_[2]), twice_[0] + k * (twice_[1] + k * twice_[2])};
  }
  Integrals closed_integrals(double k) const;

  bool smooth_ = true;
  double step_s_ = 1e-3;
  double damping_ = 0.0;  ///< over mass
  double per_mass_ = 1.0;
  double per_mass_step_ = 1.0;
  std::array<double, 3> once_{};
  std::array<double, 3> twice_{};
};

}  // namespace supercoil::host_sim
