// Any estimator in any arithmetic behind one call, with the trust that its result deserves.
#pragma once

#include <optional>
#include <variant>

#include "supercoil/control/estimation/gradient.hpp"
#include "supercoil/control/estimation/least_squares.hpp"
#include "supercoil/control/scalar/kinds.hpp"

namespace supercoil::control {

/// The numbers are sent over CAN: a new one comes last.
enum class EstimatorKind { none, gradient, least_squares };

/// What an Estimator is made of. Of the estimators' own settings only those of `kind` are used.
/// Nothing is checked here: see supported() and check_fit().
struct EstimatorSettings {
  EstimatorKind kind = EstimatorKind::gradient;
  Arithmetic arithmetic = Arithmetic::float64;
  GradientSettings gradient;
  LeastSquaresSettings least_squares;
  ExcitationMonitor::Settings excitation;

  /// Sets the muscle from which each begins. max_W: of its channel; NaN while unknown.
  void set_nominal(const PhysicalParameters& muscle, double max_W);
  /// Each begins at this muscle's θ; the nominal muscle, the scale, stays.
  void begin_at(const PhysicalParameters& muscle);
};

template <EstimatorKind Kind, EstimatorDefinition Definition, auto Member>
using ListedEstimator = Listed<EstimatorKind, Kind, Definition, Member>;

using Estimators = std::tuple<
    ListedEstimator<EstimatorKind::gradient, GradientEstimation, &EstimatorSettings::gradient>,
    ListedEstimator<EstimatorKind::least_squares, LeastSquaresEstimation,
                    &EstimatorSettings::least_squares>>;

inline constexpr auto estimator_names =
    names_of<Estimators, EstimatorKind>("none", EstimatorKind::none);

/// Least squares needs float or double: its covariance spans more than q8.24 does.
constexpr bool supported(EstimatorKind kind, Arithmetic arithmetic) {
  return runs_in<Estimators>(kind, arithmetic);
}

/// The first setting that q8.24 cannot hold (see controller_settings.hpp).
std::optional<Violation> check_fit(const EstimatorSettings& settings, double step_s, double max_W);

/// The gradient law or least squares, or none. Positions in metres, powers in watts, one step()
/// every step_s. No heap and no exception in a step.
class Estimator {
 public:
  /// Settings must be valid, kind and arithmetic supported; step_s > 0 in seconds.
  Estimator(const EstimatorSettings& settings, double step_s);
  /// One tick: this tick's position, and the power really applied since the last one.
  void step(double position_m, double applied_power_W);
  /// Call after a pause without steps: what was learned stays, but is not trusted until the signals
  /// have forgotten the motion before the pause.
  void restart();
  /// Empty for "none".
  const std::optional<Estimate>& estimate() const { return estimate_; }

 private:
  template <class Definition, class Scalar>
  struct Running {
    using Of = Definition;
    using ScalarType = Scalar;
    Running(const typename Definition::Settings& settings, double step_s)
        : estimator(settings, step_s) {}

    typename Definition::template In<Scalar> estimator;
  };
  using Any = VariantOf<std::monostate, Running, Estimators>::Type;
  static Any make(const EstimatorSettings& settings, double step_s);
  template <class Now>
  void publish(const Now& running);

  Any any_;
  RegressionScale scale_;
  double to_watts_;
  ExcitationMonitor excitation_;
  double trusted_error_;
  std::optional<Estimate> estimate_;
};

}  // namespace supercoil::control
