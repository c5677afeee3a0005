#include "supercoil/control/estimation/estimator.hpp"

namespace supercoil::control {

Estimator::Any Estimator::choose(const EstimatorSettings& s, double step_s) {
  if (s.kind == EstimatorKind::none) return std::monostate{};
  switch (s.arithmetic) {
    case Arithmetic::float32:
      return GradientEstimator<float>(s.gradient, step_s);
    case Arithmetic::q8_24:
      return GradientEstimator<Q8_24>(s.gradient, step_s);
    case Arithmetic::float64:
      break;
  }
  return GradientEstimator<double>(s.gradient, step_s);
}

Estimator::Estimator(const EstimatorSettings& settings, double step_s)
    : any_(choose(settings, step_s)),
      to_watts_(1.0 / settings.gradient.scale.dc_gain_m_per_W),
      excitation_(settings.excitation, step_s) {}

void Estimator::step(double position_m, double applied_power_W) {
  std::visit(
      [&](auto& estimator) {
        using Kind = std::decay_t<decltype(estimator)>;
        if constexpr (!std::is_same_v<Kind, std::monostate>) {
          using Scalar = typename Kind::ScalarType;
          estimator.step(Scalar(position_m * to_watts_), Scalar(applied_power_W));
          const auto& model = estimator.model();
          excitation_.step(model.phi().template cast<double>(), static_cast<double>(model.z()),
                           estimator.scaled_theta());
        }
      },
      any_);
}

void Estimator::restart() {
  std::visit(
      [](auto& estimator) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(estimator)>, std::monostate>) {
          estimator.restart();
        }
      },
      any_);
}

std::optional<Estimate> Estimator::estimate() const {
  return std::visit(
      [&](const auto& estimator) -> std::optional<Estimate> {
        if constexpr (std::is_same_v<std::decay_t<decltype(estimator)>, std::monostate>) {
          return std::nullopt;
        } else {
          return Estimate{estimator.theta(), estimator.error(), excitation_.smallest_eigenvalue(),
                          excitation_.error_bound(), excitation_.trusted()};
        }
      },
      any_);
}

}  // namespace supercoil::control
