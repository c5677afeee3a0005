#include "supercoil/control/estimation/estimator.hpp"

namespace supercoil::control {

namespace {

/// How many standard deviations make least squares' bound.
constexpr double deviations_of_bound = 3.0;

const RegressionScale& scale_of(const EstimatorSettings& s) {
  return s.kind == EstimatorKind::least_squares ? s.least_squares.scale : s.gradient.scale;
}

template <class Kind>
constexpr bool is_none = std::is_same_v<std::decay_t<Kind>, std::monostate>;
template <class Kind>
concept Gradient = requires(const Kind& kind) {
  kind.model();
};

}  // namespace

double relative_error_bound(const Vector<double, 5>& deviations) {
  return deviations_of_bound * deviations.head<4>().norm();
}

Estimator::Any Estimator::choose(const EstimatorSettings& s, double step_s) {
  const bool narrow = s.arithmetic == Arithmetic::float32;
  switch (s.kind) {
    case EstimatorKind::none:
      return std::monostate{};
    case EstimatorKind::least_squares:
      if (narrow) return LeastSquaresEstimator<float>(s.least_squares, step_s);
      return LeastSquaresEstimator<double>(s.least_squares, step_s);
    case EstimatorKind::gradient:
      break;
  }
  if (narrow) return GradientEstimator<float>(s.gradient, step_s);
  if (s.arithmetic == Arithmetic::q8_24) return GradientEstimator<Q8_24>(s.gradient, step_s);
  return GradientEstimator<double>(s.gradient, step_s);
}

Estimator::Estimator(const EstimatorSettings& settings, double step_s)
    : any_(choose(settings, step_s)),
      to_watts_(1.0 / scale_of(settings).dc_gain_m_per_W),
      nominal_(scale_of(settings).nominal),
      excitation_(settings.excitation, step_s),
      trusted_error_(settings.excitation.trusted_error) {}

void Estimator::step(double position_m, double applied_power_W) {
  std::visit(
      [&](auto& estimator) {
        using Kind = std::decay_t<decltype(estimator)>;
        if constexpr (!is_none<Kind>) {
          using Scalar = typename Kind::ScalarType;
          estimator.step(Scalar(position_m * to_watts_), Scalar(applied_power_W));
        }
        if constexpr (Gradient<Kind>) {
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
        if constexpr (!is_none<decltype(estimator)>) estimator.restart();
      },
      any_);
}

template <class Scalar>
Estimate Estimator::estimate_of(const GradientEstimator<Scalar>& estimator) const {
  return {.theta = estimator.theta(),
          .prediction_error_W = estimator.error(),
          .excitation_W2s = excitation_.min_eigenvalue(),
          .relative_error_bound = excitation_.error_bound(),
          .trusted = excitation_.trusted(),
          .settled = excitation_.trusted()};
}

template <class Scalar>
Estimate Estimator::estimate_of(const LeastSquaresEstimator<Scalar>& estimator) const {
  const auto& parameters = estimator.parameters();
  const auto& deviations = estimator.standard_deviations();
  const double bound = relative_error_bound(deviations);
  return {.theta = parameters.template head<4>().cwiseProduct(nominal_),
          .prediction_error_W = estimator.error(),
          .relative_error_bound = bound,
          .trusted = bound <= trusted_error_,
          .settled = estimator.settled(),
          .bias_W = parameters[4],
          .deviation = deviations.template head<4>().cwiseProduct(nominal_),
          .bias_deviation_W = deviations[4]};
}

std::optional<Estimate> Estimator::estimate() const {
  return std::visit(
      [&](const auto& estimator) -> std::optional<Estimate> {
        if constexpr (is_none<decltype(estimator)>) {
          return std::nullopt;
        } else {
          return estimate_of(estimator);
        }
      },
      any_);
}

}  // namespace supercoil::control
