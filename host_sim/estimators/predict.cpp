#include <cmath>

#include <Eigen/Cholesky>

#include "estimators/muscle_filter.hpp"

namespace supercoil::host_sim::estimators {

bool predict_extended(Belief& belief, double moving_mass_kg, double power_W, double step_s) {
  const Propagated next = propagated_with_derivative(belief.mean, moving_mass_kg, power_W, step_s);
  belief.mean = next.state;
  belief.covariance = (next.derivative * belief.covariance * next.derivative.transpose()).eval();
  return (belief.covariance.diagonal().array() > 0.0).all() && belief.covariance.allFinite();
}

bool predict_unscented(Belief& belief, double moving_mass_kg, double power_W, double step_s) {
  // n + κ of 3 is right for the fourth moments of a Gaussian. The mean's own point then has a
  // negative weight, and the covariance is taken about it, which keeps it positive.
  constexpr double n_and_kappa = 3.0;
  constexpr double weight = 0.5 / n_and_kappa;
  constexpr double centre_weight = 1.0 - state_size / n_and_kappa;
  constexpr int count = 2 * state_size;
  const Eigen::LLT<Covariance> root(belief.covariance);
  if (root.info() != Eigen::Success) return false;
  const Covariance spread = Covariance(root.matrixL()) * std::sqrt(n_and_kappa);
  const State centre = propagated<double>(belief.mean, moving_mass_kg, power_W, step_s);
  control::Matrix<double, state_size, count> points;
  for (int i = 0; i < state_size; ++i) {
    points.col(i) =
        propagated<double>(belief.mean + spread.col(i), moving_mass_kg, power_W, step_s);
    points.col(state_size + i) =
        propagated<double>(belief.mean - spread.col(i), moving_mass_kg, power_W, step_s);
  }
  belief.mean = weight * points.rowwise().sum() + centre_weight * centre;
  points.colwise() -= centre;
  belief.covariance = weight * points * points.transpose();
  return belief.covariance.allFinite();
}

}  // namespace supercoil::host_sim::estimators
