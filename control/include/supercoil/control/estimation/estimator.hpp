// Any estimator in any arithmetic behind one call, with the trust that its result deserves.
#pragma once

#include <optional>
#include <variant>

#include "supercoil/control/estimation/excitation.hpp"
#include "supercoil/control/estimation/gradient.hpp"
#include "supercoil/control/scalar/arithmetic.hpp"

namespace supercoil::control {

enum class EstimatorKind { none, gradient };

inline constexpr Names<EstimatorKind, 2> estimator_names{
    {{"none", EstimatorKind::none}, {"gradient", EstimatorKind::gradient}}};

struct EstimatorSettings {
  EstimatorKind kind = EstimatorKind::gradient;
  Arithmetic arithmetic = Arithmetic::float64;
  GradientSettings gradient;
  ExcitationMonitor::Settings excitation;
};

/// What q8.24 cannot hold of the settings (see controller.hpp).
std::optional<Violation> check_fit(const EstimatorSettings& settings, double step_s, double max_W);

struct Estimate {
  Theta theta;                  ///< in θ's own units
  double prediction_error_W;    ///< ε = z − θᵀφ, through 1/Λ
  double excitation_W2s;        ///< λmin of ∫φφᵀ, see ExcitationMonitor
  double relative_error_bound;  ///< of all parameters together; infinity at first
  bool trusted;
};

class Estimator {
 public:
  /// Settings must be valid; step_s > 0 in seconds.
  Estimator(const EstimatorSettings& settings, double step_s);
  /// One tick: this tick's position, and the power really applied since the last one.
  void step(double position_m, double applied_power_W);
  /// After a pause in which it was not stepped: signals start at rest, what was learned stays.
  void restart();
  /// Empty for "none".
  std::optional<Estimate> estimate() const;

 private:
  using Any = std::variant<std::monostate, GradientEstimator<double>, GradientEstimator<float>,
                           GradientEstimator<Q8_24>>;
  static Any choose(const EstimatorSettings& settings, double step_s);

  Any any_;
  double to_watts_;
  ExcitationMonitor excitation_;
};

}  // namespace supercoil::control
