#include "supercoil/control/estimation/batch_least_squares.hpp"

#include <cmath>

#include <Eigen/LU>

namespace supercoil::control {

namespace {

/// Λ = (s + 10)⁵. Two poles more than s³X needs keep noise out; at 10 rad/s they pass the muscle's
/// mechanics, and little of what its heat does between two samples. 8 to 14 rad/s identify the same
/// muscles.
constexpr double pole_rad_per_s = 10.0;
constexpr Polynomial<2> two_poles{pole_rad_per_s * pole_rad_per_s, 2.0 * pole_rad_per_s, 1.0};
constexpr Polynomial<5> lambda =
    multiply<4, 1>(multiply<2, 2>(two_poles, two_poles), Polynomial<1>{pole_rad_per_s, 1.0});

/// The believed muscle from power to position, over its DC gain.
Polynomial<3> denominator(const PhysicalParameters& believed) {
  const TransferFunction f = transfer_function_from(believed);
  return {f.b0, f.b1, f.b2, 1.0};
}

}  // namespace

BatchLeastSquares::BatchLeastSquares(const PhysicalParameters& believed, double step_s)
    : position_scale_(1.0 / believed.dc_gain_m_per_W()),
      nominal_(theta_from(believed)),
      power_(lambda, step_s),
      position_(lambda, step_s),
      believed_gain_(denominator(believed)[0]),
      believed_(denominator(believed), step_s),
      instrument_(lambda, step_s) {
  const Theta units = nominal_ * believed.dc_gain_m_per_W();
  weights_ << units[0] * believed.moving_mass_kg, units[1], units[2], units[3], 0.0;
  weights_ *= lambda[0];
}

void BatchLeastSquares::Sums::add(const Sums& other, double sign) {
  instrumental += sign * other.instrumental;
  correlation += sign * other.correlation;
  information += sign * other.information;
  projection += sign * other.projection;
  energy += sign * other.energy;
  mean += sign * other.mean;
  count += sign * other.count;
}

void BatchLeastSquares::restart() {
  blocks_ = 0;
  sums_.fill({});
}

void BatchLeastSquares::start(double position_m) {
  restart();
  power_.settle(0.0);
  position_.settle(position_m * position_scale_);
  believed_.settle(0.0);
  instrument_.settle(0.0);
}

BatchLeastSquares::Regressors BatchLeastSquares::regressors(
    const Vector<double, 5>& position) const {
  Regressors phi;
  phi << position[3], position[2], position[1], position[0], 0.0;
  phi = phi.cwiseProduct(weights_).eval();
  phi[4] = 1.0;
  return phi;
}

void BatchLeastSquares::step(double position_m, double applied_power_W,
                             std::optional<std::size_t> block) {
  power_.step(applied_power_W);
  position_.step(position_m * position_scale_);
  believed_.step(applied_power_W);
  instrument_.step(believed_.state()[0] * believed_gain_);
  if (!block || *block >= max_blocks) return;
  blocks_ = *block + 1;
  Sums& sums = sums_[*block];
  const double z = power_.state()[0] * lambda[0];
  const Regressors phi = regressors(position_.state());
  const Regressors instrument = regressors(instrument_.state());
  sums.instrumental += instrument * phi.transpose();
  sums.correlation += instrument * z;
  sums.information += phi * phi.transpose();
  sums.projection += phi * z;
  sums.energy += z * z;
  sums.mean += z;
  sums.count += 1.0;
}

BatchLeastSquares::Sums BatchLeastSquares::sum(std::size_t from, std::size_t to) const {
  Sums total;
  for (std::size_t i = from; i < to; ++i)
    total.add(sums_[i], 1.0);
  return total;
}

BatchLeastSquares::Regressors BatchLeastSquares::solve(const Sums& sums) {
  return sums.instrumental.partialPivLu().solve(sums.correlation);
}

double BatchLeastSquares::unexplained_ratio(const Sums& experiment, const Theta& theta) const {
  Regressors solution;
  solution << theta.cwiseQuotient(nominal_), 0.0;
  // The column of ones gives the mean of the residual.
  solution[4] =
      (experiment.projection[4] - experiment.information.row(4).dot(solution)) / experiment.count;
  return std::fmax(experiment.residual_energy(solution), 0.0) / experiment.variance();
}

std::optional<BatchLeastSquares::Fit> BatchLeastSquares::fit() const {
  if (blocks_ < min_blocks) return std::nullopt;
  const std::size_t fitted = (2 * blocks_ + 1) / 3;
  const Sums all = sum(0, blocks_);
  const Sums holdout = sum(fitted, blocks_);
  const Regressors found = solve(all);
  const Regressors before = solve(sum(0, fitted));
  const Regressors after = solve(holdout);

  Regressors spread = Regressors::Zero();
  for (std::size_t i = 0; i < blocks_; ++i) {
    Sums others = all;
    others.add(sums_[i], -1.0);
    spread += (solve(others) - found).cwiseAbs2();
  }
  const auto n = static_cast<double>(blocks_);
  const Regressors deviation = (spread * ((n - 1.0) / n)).cwiseSqrt();

  const double variance = holdout.variance();
  Fit fit;
  fit.theta = found.head<4>().cwiseProduct(nominal_);
  fit.bias_W = found[4];
  fit.deviation = deviation.head<4>().cwiseQuotient(found.head<4>().cwiseAbs());
  fit.holdout_difference =
      (after - before).head<4>().cwiseAbs().cwiseQuotient(before.head<4>().cwiseAbs());
  fit.unexplained_ratio = std::fmax(holdout.residual_energy(before), 0.0) / variance;
  const bool finite = fit.theta.allFinite() && fit.deviation.allFinite() &&
                      fit.holdout_difference.allFinite() && variance > 0.0;
  return finite ? std::optional(fit) : std::nullopt;
}

}  // namespace supercoil::control
