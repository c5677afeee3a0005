#include "supercoil/control/estimation/estimator.hpp"

#include <type_traits>

#include "supercoil/control/actuator/conversions.hpp"

namespace supercoil::control {

namespace {

/// The error bound of least squares, in standard deviations.
constexpr double deviations_of_bound = 3.0;

RegressionScale scale_of(const EstimatorSettings& settings) {
  RegressionScale scale;
  with_chosen<Estimators>(settings, [&](auto, const auto& own) { scale = own.scale; });
  return scale;
}

template <class Running>
constexpr bool is_none = std::is_same_v<std::decay_t<Running>, std::monostate>;

}  // namespace

void EstimatorSettings::set_nominal(const PhysicalParameters& muscle, double max_W) {
  const RegressionScale scale{theta_from(muscle), muscle.dc_gain_m_per_W(), muscle.moving_mass_kg};
  with_each<Estimators>(*this, [&](auto definition, auto& own) {
    decltype(definition)::set_nominal(own, scale, max_W);
  });
}

void EstimatorSettings::begin_at(const PhysicalParameters& muscle) {
  const Theta theta = theta_from(muscle);
  with_each<Estimators>(*this, [&](auto, auto& own) { own.initial = theta; });
}

void GradientEstimation::check_fit(FixedPointFit& fit, const Settings& s, double step_s) {
  constexpr double signal = FixedPointFit::signal;
  const Theta& nominal = s.scale.nominal;
  for (int i = 0; i < 4; ++i) {
    fit.gain("gain", s.gain[i] / (nominal[i] * nominal[i]) * step_s);
    fit.at_most("initial", s.initial[i] / nominal[i], signal);
    if (s.bounds) {
      fit.at_most("lower", s.bounds->lower[i] / nominal[i], signal);
      fit.at_most("upper", s.bounds->upper[i] / nominal[i], signal);
    }
  }
  fit.at_most("normalisation", s.normalisation, signal);
}

double relative_error_bound(const Vector<double, 5>& deviations) {
  return deviations_of_bound * deviations.head<4>().norm();
}

std::optional<Violation> check_fit(const EstimatorSettings& settings, double step_s, double max_W) {
  if (settings.arithmetic != Arithmetic::q8_24) return std::nullopt;
  FixedPointFit fit;
  with_chosen<Estimators>(settings, [&](auto definition, const auto& own) {
    fit.at_most("arithmetic", max_W, FixedPointFit::signal);
    if constexpr (decltype(definition)::fixed_point)
      decltype(definition)::check_fit(fit, own, step_s);
  });
  return fit.violation();
}

Estimator::Any Estimator::make(const EstimatorSettings& settings, double step_s) {
  Any made;
  with_running<Estimators>(settings, [&](auto definition, auto scalar, const auto& own) {
    made.emplace<Running<decltype(definition), decltype(scalar)>>(own, step_s);
  });
  return made;
}

Estimator::Estimator(const EstimatorSettings& settings, double step_s)
    : any_(make(settings, step_s)),
      scale_(scale_of(settings)),
      to_watts_(1.0 / scale_.dc_gain_m_per_W),
      excitation_(settings.excitation, step_s),
      trusted_error_(settings.excitation.trusted_error) {
  std::visit(
      [this](const auto& running) {
        if constexpr (!is_none<decltype(running)>) publish(running);
      },
      any_);
}

template <class Now>
void Estimator::publish(const Now& running) {
  estimate_ = Now::Of::estimate(running.estimator, scale_.nominal, excitation_, trusted_error_);
}

void Estimator::step(double position_m, double applied_power_W) {
  std::visit(
      [&](auto& running) {
        if constexpr (!is_none<decltype(running)>) {
          using Now = std::decay_t<decltype(running)>;
          using Scalar = typename Now::ScalarType;
          running.estimator.step(Scalar(position_m * to_watts_), Scalar(applied_power_W));
          Now::Of::watch(running.estimator, excitation_);
          if (Now::Of::has_new_estimate(running.estimator)) publish(running);
        }
      },
      any_);
}

void Estimator::restart() {
  std::visit(
      [](auto& running) {
        if constexpr (!is_none<decltype(running)>) running.estimator.restart();
      },
      any_);
  excitation_.restart();
  if (estimate_) estimate_->trusted = false;
}

}  // namespace supercoil::control
