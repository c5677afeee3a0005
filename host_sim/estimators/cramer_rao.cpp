#include "estimators/cramer_rao.hpp"

#include <cstdint>
#include <vector>

#include <Eigen/Cholesky>

namespace supercoil::host_sim::estimators {

CramerRaoBound::CramerRaoBound(const Experiment& experiment, const Unknown& unknown)
    : experiment_(experiment), unknown_(unknown), state_(experiment.begin) {}

void CramerRaoBound::step() {
  // The power in the middle of the step stands for that of the ticks in it.
  const double middle_s = experiment_.begin_s + (static_cast<double>(steps_) + 0.5) * step_s;
  const Propagated next = propagated_with_derivative(state_, experiment_.moving_mass_kg,
                                                     experiment_.power_W(middle_s), step_s);
  state_ = next.state;
  ++steps_;
  sensitivity_ = (next.derivative * sensitivity_).eval();
  const State output_row = sensitivity_.row(at_position);
  information_ += output_row * output_row.transpose() * (step_s / experiment_.noise_density_m2_s);
}

control::Theta CramerRaoBound::until(double time_s) {
  const std::int64_t steps = std::llround((time_s - experiment_.begin_s) / step_s);
  while (steps_ < steps)
    step();
  std::vector<int> unknowns;
  for (int i = 0; i < state_size; ++i) {
    const bool is_unknown = i < motion_size ? unknown_.motion : i != at_bias || unknown_.bias;
    if (is_unknown) unknowns.push_back(i);
  }
  // Scaled so that every information is 1: metres and logarithms differ by 1e10.
  const Eigen::MatrixXd information = information_(unknowns, unknowns);
  const Eigen::VectorXd scale = information.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<Eigen::MatrixXd> factors(scale.asDiagonal() * information * scale.asDiagonal());
  if (!scale.allFinite() || !factors.isPositive() || factors.rcond() < 1e-14)
    return control::Theta::Constant(INFINITY);
  const Eigen::MatrixXd inverse =
      factors.solve(Eigen::MatrixXd::Identity(information.rows(), information.cols()));
  const Eigen::VectorXd deviations = inverse.diagonal().cwiseSqrt().cwiseProduct(scale);
  const int first = unknown_.motion ? motion_size : 0;
  return deviations.segment<parameter_size>(first);
}

}  // namespace supercoil::host_sim::estimators
