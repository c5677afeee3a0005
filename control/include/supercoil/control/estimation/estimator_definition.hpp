// What each estimator declares besides its equations.
#pragma once

#include <concepts>
#include <string_view>

#include "supercoil/control/estimation/estimate.hpp"
#include "supercoil/control/estimation/excitation.hpp"
#include "supercoil/control/estimation/parametric_model.hpp"
#include "supercoil/control/scalar/fixed_point_fit.hpp"
#include "supercoil/control/scalar/setting_value.hpp"

namespace supercoil::control {

/// One tick is step(position in watts at rest, power really applied since the last one).
template <class Running, class Scalar>
concept ParameterEstimator = requires(Running running, Scalar scalar) {
  running.step(scalar, scalar);
  running.restart();
};

/// In<Scalar>: the estimator, made from its settings and step_s. watch(): each tick after step(),
/// for estimators whose trust depends on excitation. has_new_estimate(): whether estimate() may
/// have changed in this tick. estimate(): its result, and whether that is trusted, given the
/// nominal θ and the maximum relative error. set_nominal(): max_W is NaN while unknown. values: a
/// range of SettingValue. If it runs in fixed_point, check_fit(fit, settings, step_s).
template <class Definition, class Running = typename Definition::template In<double>,
          class Value = SettingValue<typename Definition::Settings>>
concept EstimatorDefinition = ParameterEstimator<Running, double> &&
    requires(typename Definition::Settings settings, const Running& running,
             ExcitationMonitor excitation, const RegressionScale& scale, const Theta& nominal,
             double value) {
  { Definition::name } -> std::convertible_to<std::string_view>;
  { Definition::fixed_point } -> std::convertible_to<bool>;
  Definition::set_nominal(settings, scale, value);
  { *Definition::values.begin() } -> std::convertible_to<Value>;
  Definition::watch(running, excitation);
  { Definition::has_new_estimate(running) } -> std::same_as<bool>;
  { Definition::estimate(running, nominal, excitation, value) } -> std::same_as<Estimate>;
};

}  // namespace supercoil::control
