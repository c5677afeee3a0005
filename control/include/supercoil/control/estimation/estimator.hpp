// Any estimator in any arithmetic behind one call, with the trust that its result deserves.
#pragma once

#include <optional>
#include <variant>

#include "supercoil/control/estimation/estimate.hpp"
#include "supercoil/control/estimation/excitation.hpp"
#include "supercoil/control/estimation/gradient.hpp"
#include "supercoil/control/estimation/least_squares.hpp"
#include "supercoil/control/scalar/arithmetic.hpp"

namespace supercoil::control {

enum class EstimatorKind { none, gradient, least_squares };

inline constexpr Names<EstimatorKind, 3> estimator_names{
    {{"none", EstimatorKind::none},
     {"gradient", EstimatorKind::gradient},
     {"least_squares", EstimatorKind::least_squares}}};

/// Least squares needs float or double: its covariance spans more than q8.24 does.
constexpr bool supported(EstimatorKind kind, Arithmetic arithmetic) {
  return kind != EstimatorKind::least_squares || arithmetic != Arithmetic::q8_24;
}

struct EstimatorSettings {
  EstimatorKind kind = EstimatorKind::gradient;
  Arithmetic arithmetic = Arithmetic::float64;
  GradientSettings gradient;
  LeastSquaresSettings least_squares;
  ExcitationMonitor::Settings excitation;
};

/// Of θ1…θ4 together, by least squares' standard deviations over nominal.
double relative_error_bound(const Vector<double, 5>& deviations);

/// What q8.24 cannot hold of the settings (see controller.hpp).
std::optional<Violation> check_fit(const EstimatorSettings& settings, double step_s, double max_W);

class Estimator {
 public:
  /// Settings must be valid, kind and arithmetic supported; step_s > 0 in seconds.
  Estimator(const EstimatorSettings& settings, double step_s);
  /// One tick: this tick's position, and the power really applied since the last one.
  void step(double position_m, double applied_power_W);
  /// After a pause in which it was not stepped: signals start at rest, what was learned stays.
  void restart();
  /// Empty for "none".
  std::optional<Estimate> estimate() const;

 private:
  using Any = std::variant<std::monostate, GradientEstimator<double>, GradientEstimator<float>,
                           GradientEstimator<Q8_24>, LeastSquaresEstimator<double>,
                           LeastSquaresEstimator<float>>;
  static Any choose(const EstimatorSettings& settings, double step_s);
  template <class Scalar>
  Estimate estimate_of(const GradientEstimator<Scalar>& estimator) const;
  template <class Scalar>
  Estimate estimate_of(const LeastSquaresEstimator<Scalar>& estimator) const;

  Any any_;
  double to_watts_;
  Theta nominal_;
  ExcitationMonitor excitation_;
  double trusted_error_;
};

}  // namespace supercoil::control
