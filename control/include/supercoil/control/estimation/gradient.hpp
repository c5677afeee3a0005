// The paper's gradient estimator.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "supercoil/control/estimation/estimator_definition.hpp"
#include "supercoil/control/estimation/projection.hpp"

namespace supercoil::control {

/// θ̇ = Γ ε φ, ε = z − θᵀφ (paper, Eq. (4)). The defaults are the paper's (Sec. 5.1).
struct GradientSettings {
  Polynomial<3> lambda = paper_lambda;
  Theta gain{0.6e7, 0.4e7, 0.7e7, 0.09e7};  ///< diagonal of Γ, > 0
  Theta initial{0.1, 5.0, 30.0, 20.0};      ///< θ(0)
  RegressionScale scale;
  /// When given, θ is kept inside (in θ's own units).
  std::optional<Box<double, 4>> bounds;
  /// Divides ε by 1 + normalisation · φᵀ(Γ·step)φ; 0 is the paper's law. From 0.5 on every Euler
  /// step shrinks the error along φ, whatever the gain and the signals' size.
  double normalisation = 0.0;
};

/// The law of GradientSettings in one arithmetic, by Euler steps of step_s.
template <class Scalar>
class GradientEstimator {
 public:
  using ScalarType = Scalar;

  /// step_s: the sampling period in seconds, > 0.
  GradientEstimator(const GradientSettings& settings, double step_s)
      : model_(settings.lambda, settings.scale, step_s),
        free_ticks_(std::llround(free_ratio * settings.lambda[1] / settings.lambda[0] / step_s)),
        nominal_(settings.scale.nominal) {
    const Theta squared = nominal_.cwiseProduct(nominal_);
    gain_step_ = (settings.gain.cwiseQuotient(squared) * step_s).template cast<Scalar>();
    normalisation_ = to<Scalar>(settings.normalisation);
    normalised_ = settings.normalisation > 0.0;
    theta_ = settings.initial.cwiseQuotient(nominal_).template cast<Accumulator<Scalar>>();
    if (settings.bounds) {
      bounds_ = Box<Accumulator<Scalar>, 4>{
          settings.bounds->lower.cwiseQuotient(nominal_).template cast<Accumulator<Scalar>>(),
          settings.bounds->upper.cwiseQuotient(nominal_).template cast<Accumulator<Scalar>>()};
    }
  }

  /// One tick. position_W: position over the DC gain. applied_power_W: the power really applied
  /// since the last tick.
  void step(Scalar position_W, Scalar applied_power_W) {
    model_.step(position_W, applied_power_W);
    if (waits_ > 0) {
      --waits_;
      return;
    }
    const Vector<Scalar, 4>& phi = model_.phi();
    const Vector<Scalar, 4> theta = theta_.template cast<Scalar>();
    error_ = model_.z() - theta.dot(phi);
    const Vector<Scalar, 4> direction = gain_step_.cwiseProduct(phi);
    Scalar drive = error_;
    if (normalised_) drive /= to<Scalar>(1) + direction.dot(phi) * normalisation_;
    // Forward Euler is enough for the adaptation: stable from 0.1 to 50 ms with the paper's gains.
    theta_ += direction.template cast<Accumulator<Scalar>>() * Accumulator<Scalar>(drive);
    if (bounds_) theta_ = project(theta_, *bounds_);
  }

  /// The muscle is heated again after a pause, warm and moving: the filters start where it is, and
  /// θ stays until they have forgotten how it moved before.
  void restart() {
    if (!model_.has_stepped()) return;
    model_.restart();
    error_ = Scalar{};
    waits_ = free_ticks_;
  }

  /// θ in its own units.
  Theta theta() const { return theta_.template cast<double>().cwiseProduct(nominal_); }
  /// θ over its nominal values, as the regression has it.
  Vector<double, 4> scaled_theta() const { return theta_.template cast<double>(); }
  /// ε = z − θᵀφ of this tick, in watts through 1/Λ.
  double error() const { return static_cast<double>(error_); }
  const ParametricModel<Scalar>& model() const { return model_; }

 private:
  /// Of the sum of Λ's time constants: after it 0.1 % is left of a free response.
  static constexpr double free_ratio = 7.0;

  ParametricModel<Scalar> model_;
  std::int64_t free_ticks_;
  std::int64_t waits_ = 0;  ///< ticks until θ adapts again
  Theta nominal_;
  Vector<Scalar, 4> gain_step_;  // Γ·step over the squared scale: Γ itself exceeds Q8.24
  Scalar normalisation_{};
  bool normalised_ = false;
  Vector<Accumulator<Scalar>, 4> theta_;
  std::optional<Box<Accumulator<Scalar>, 4>> bounds_;
  Scalar error_{};
};

/// Trusted and settled according to its ExcitationMonitor.
struct GradientEstimation {
  using Settings = GradientSettings;
  template <class Scalar>
  using In = GradientEstimator<Scalar>;
  static constexpr std::string_view name = "gradient";
  static constexpr bool fixed_point = true;
  static constexpr std::array values{
      element_value<Settings, &Settings::gain, 0>("gain_1"),
      element_value<Settings, &Settings::gain, 1>("gain_2"),
      element_value<Settings, &Settings::gain, 2>("gain_3"),
      element_value<Settings, &Settings::gain, 3>("gain_4"),
      setting_value<Settings, &Settings::normalisation>("normalisation")};

  static void set_nominal(Settings& s, const RegressionScale& scale, double /*max_W*/) {
    s.scale = scale;
  }
  static void check_fit(FixedPointFit& fit, const Settings& s, double step_s);

  template <class Scalar>
  static void watch(const GradientEstimator<Scalar>& estimator, ExcitationMonitor& excitation) {
    const auto& model = estimator.model();
    excitation.step(model.phi().template cast<double>(), static_cast<double>(model.z()),
                    estimator.scaled_theta());
  }
  template <class Scalar>
  static bool has_new_estimate(const GradientEstimator<Scalar>&) {
    return true;
  }
  template <class Scalar>
  static Estimate estimate(const GradientEstimator<Scalar>& estimator, const Theta& /*nominal*/,
                           const ExcitationMonitor& excitation, double /*trusted_error*/) {
    return {.theta = estimator.theta(),
            .prediction_error_W = estimator.error(),
            .excitation_W2s = excitation.min_eigenvalue(),
            .relative_error_bound = excitation.error_bound(),
            .trusted = excitation.trusted(),
            .settled = excitation.trusted()};
  }
};

}  // namespace supercoil::control
