#include "loop/estimation.hpp"

#include <cmath>
#include <utility>

#include "supercoil/control/actuator/conversions.hpp"

namespace supercoil {

namespace {

/// Estimators return infinity for a deviation that they cannot determine.
double nan_if_infinite(double deviation) {
  return std::isfinite(deviation) ? deviation : std::nan("");
}

}  // namespace

Estimation::Estimation(const std::vector<control::EstimatorSettings>& estimators, double step_s) {
  for (const auto& estimator : estimators)
    estimators_.emplace_back(estimator, step_s);
}

void Estimation::choose(std::size_t place) {
  chosen_ = place;
  restart();
}

void Estimation::exchange(std::size_t place, control::Estimator& estimator) {
  std::swap(estimators_[place], estimator);
  if (place == chosen_) choose(place);
}

std::optional<control::PhysicalParameters> Estimation::trusted_muscle(
    const control::PhysicalParameters& known) const {
  if (!trusted()) return std::nullopt;
  return control::physical_from(estimate()->theta,
                                {known.force_per_kelvin_N_per_K, known.moving_mass_kg});
}

void Estimation::publish(std::uint32_t selector, Snapshot& s) const {
  static const control::Estimate nothing{.theta = control::Theta::Constant(std::nan("")),
                                         .relative_error_bound = std::nan("")};
  const control::Estimate& e = estimate() ? *estimate() : nothing;
  s.theta = e.theta;
  s.error_bound = e.relative_error_bound;
  s.trusted = e.trusted;
  s.deviation = e.deviation.unaryExpr([](double each) { return nan_if_infinite(each); });
  s.bias_deviation_W = nan_if_infinite(e.bias_deviation_W);
  // No bias without a standard deviation.
  const bool has_bias = !std::isnan(s.bias_deviation_W);
  s.bias_W = has_bias ? e.bias_W : s.bias_deviation_W;
  constexpr std::uint64_t multiplexed = multiplexed_names.size() - 1;
  s.multiplexed_selector =
      has_bias ? static_cast<std::uint8_t>(1 + (selector * multiplexed >> 32U)) : std::uint8_t{0};
}

}  // namespace supercoil
