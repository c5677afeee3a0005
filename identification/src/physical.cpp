#include "supercoil/identification/physical.hpp"

#include <cmath>

#include "supercoil/control/actuator/conversions.hpp"

namespace supercoil::identification {

control::PhysicalParameters physical_from(const Muscle& muscle, const Assumed& assumed) {
  const double w = muscle.natural_frequency_rad_per_s;
  control::PhysicalParameters p;
  p.thermal_mass_J_per_K = assumed.thermal_mass_J_per_K;
  p.heat_transfer_W_per_K = assumed.thermal_mass_J_per_K / muscle.time_constant_s;
  p.stiffness_N_per_m =
      assumed.moving_mass_kg ? *assumed.moving_mass_kg * w * w : assumed.stiffness_N_per_m;
  p.moving_mass_kg = p.stiffness_N_per_m / (w * w);
  p.damping_Ns_per_m = 2.0 * muscle.damping_ratio / w * p.stiffness_N_per_m;
  p.force_per_kelvin_N_per_K = muscle.gain_m_per_W * p.heat_transfer_W_per_K * p.stiffness_N_per_m;
  return p;
}

ThetaEstimate theta_of(const Fit& fit, const Assumed& assumed) {
  const auto theta_at = [&](const Eigen::VectorXd& numbers) {
    return control::theta_from(physical_from(muscle_from(fit.parameters, numbers), assumed));
  };
  constexpr double step = 1e-4;
  Eigen::MatrixXd slopes(4, fit.numbers.size());
  for (Eigen::Index i = 0; i < fit.numbers.size(); ++i) {
    Eigen::VectorXd above = fit.numbers;
    Eigen::VectorXd below = fit.numbers;
    above[i] += step;
    below[i] -= step;
    slopes.col(i) = (theta_at(above) - theta_at(below)) / (2.0 * step);
  }
  const Eigen::MatrixXd covariance = slopes * fit.covariance * slopes.transpose();
  return {theta_at(fit.numbers), covariance.diagonal().cwiseSqrt()};
}

}  // namespace supercoil::identification
