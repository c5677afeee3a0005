#include "supercoil/control/estimation/batch_least_squares.hpp"

#include <cstdint>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace supercoil::control {

BatchLeastSquares::BatchLeastSquares(const Settings& settings, double duration_s, double step_s)
    : settings_(settings),
      step_s_(step_s),
      first_tick_(static_cast<std::int64_t>(settings.settle_s / step_s)),
      fit_until_(static_cast<std::int64_t>(
          (settings.settle_s + settings.fit_part * (duration_s - settings.settle_s)) / step_s)),
      model_(settings.lambda, settings.scale, step_s) {}

void BatchLeastSquares::step(double position_m, double applied_power_W) {
  model_.step(position_m / settings_.scale.dc_gain_m_per_W, applied_power_W);
  if (tick_++ < first_tick_) return;
  Sums& sums = tick_ <= fit_until_ ? fitted_ : unseen_;
  const Vector<double, 4>& phi = model_.phi();
  sums.information += phi * phi.transpose() * step_s_;
  sums.correlation += phi * (model_.z() * step_s_);
  sums.energy += model_.z() * model_.z() * step_s_;
}

std::optional<BatchLeastSquares::Fit> BatchLeastSquares::fit() const {
  const Eigen::LDLT<Matrix<double, 4>> solver(fitted_.information);
  if (solver.info() != Eigen::Success || !solver.isPositive()) return std::nullopt;
  const Vector<double, 4> theta = solver.solve(fitted_.correlation);
  const Eigen::SelfAdjointEigenSolver<Matrix<double, 4>> spectrum(unseen_.information,
                                                                  Eigen::EigenvaluesOnly);
  const double smallest = spectrum.eigenvalues()[0];
  const double missed = unseen_.energy - 2.0 * theta.dot(unseen_.correlation) +
                        theta.dot(unseen_.information * theta);
  if (!theta.allFinite() || !(smallest > 0.0) || !(unseen_.energy > 0.0)) return std::nullopt;
  const double error = std::sqrt(std::fmax(missed, 0.0) / smallest);
  return Fit{theta.cwiseProduct(settings_.scale.nominal), error,
             std::fmax(missed, 0.0) / unseen_.energy};
}

}  // namespace supercoil::control
