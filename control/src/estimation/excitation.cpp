#include "supercoil/control/estimation/excitation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Eigenvalues>

namespace supercoil::control {

ExcitationMonitor::ExcitationMonitor(const Settings& settings, double step_s)
    : step_s_(step_s),
      trusted_error_(settings.trusted_error),
      ticks_per_block_(std::max<std::int64_t>(
          1, std::llround(settings.window_s / (step_s * static_cast<double>(blocks))))) {}

void ExcitationMonitor::close_block(const Vector<double, 4>& theta) {
  history_[next_block_] = current_;
  next_block_ = (next_block_ + 1) % blocks;
  filled_ = std::min(filled_ + 1, blocks);
  current_ = Block{};
  ticks_in_block_ = 0;
  if (filled_ < blocks) return;
  Block sum;
  for (const Block& block : history_) {
    sum.information += block.information;
    sum.correlation += block.correlation;
    sum.energy += block.energy;
  }
  const Matrix<double, 4> information = sum.information.selfadjointView<Eigen::Lower>();
  const Eigen::SelfAdjointEigenSolver<Matrix<double, 4>> solver(information * step_s_,
                                                                Eigen::EigenvaluesOnly);
  min_eigenvalue_ = std::max(0.0, solver.eigenvalues()[0]);
  const double left =
      sum.energy - 2.0 * theta.dot(sum.correlation) + theta.dot(information * theta);
  error_bound_ = min_eigenvalue_ > 0.0 ? std::sqrt(std::max(0.0, left) * step_s_ / min_eigenvalue_)
                                       : std::numeric_limits<double>::infinity();
}

void ExcitationMonitor::restart() {
  current_ = Block{};
  ticks_in_block_ = 0;
  filled_ = 0;
  min_eigenvalue_ = 0.0;
  error_bound_ = std::numeric_limits<double>::infinity();
}

}  // namespace supercoil::control
