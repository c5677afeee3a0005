// What does not fit into fixed point: signals and gains in 8 bits before the point, states in 16.
#include <algorithm>
#include <cmath>

#include "supercoil/control/estimation/estimator.hpp"
#include "supercoil/control/tracking/controller.hpp"

namespace supercoil::control {

namespace {

constexpr double signal = 127.0;
constexpr double state = 32767.0;
/// A gain of fewer steps than this is lost in rounding.
constexpr double min_gain = 16.0 / (1 << 24);

/// Remembers the first quantity that is out of its range.
class Fit {
 public:
  void at_most(const char* quantity, double value, double highest) {
    check({quantity, value, -highest, highest});
  }
  void gain(const char* quantity, double value) { check({quantity, value, min_gain, signal}); }
  const std::optional<Violation>& violation() const { return violation_; }

 private:
  void check(const Violation& v) {
    if (!violation_ && !(v.value >= v.lowest && v.value <= v.highest)) violation_ = v;
  }
  std::optional<Violation> violation_;
};

void check_mrac(Fit& fit, const MracSettings& m, double step_s, double peak_W) {
  fit.at_most("lambda", std::max(std::abs(m.lambda[0]), std::abs(m.lambda[1])), state);
  fit.at_most("alpha", std::max(m.alpha[0], m.alpha[1]), state);
  // The largest that ω1 and ω2 become for a signal of peak_W: at rest, and at the filter's
  // middle.
  fit.at_most("alpha", peak_W * std::abs(m.alpha[1] / m.lambda[0]), signal);
  fit.at_most("alpha", peak_W * std::abs(m.alpha[0] / m.lambda[1]), signal);
  for (const double gain : m.gain)
    fit.gain("gain", gain * step_s);
  for (const double value : m.initial)
    fit.at_most("initial", value, signal);
  fit.at_most("sigma_gain", m.sigma_gain, state);
  fit.at_most("initial_sigma", m.initial_sigma, state);
  fit.at_most("damping", m.damping, state);
  if (!m.bounds) return;
  // θ is used in 8 bits: bounds beyond them would not bound.
  for (const double value : m.bounds->lower)
    fit.at_most("lower", std::max(value, -signal), signal);
  for (const double value : m.bounds->upper)
    fit.at_most("upper", std::min(value, signal), signal);
}

}  // namespace

std::optional<Violation> check_fit(const ControllerSettings& settings, double step_s,
                                   double max_reference_m, double max_W) {
  if (settings.arithmetic != Arithmetic::q8_24 || settings.kind == ControllerKind::power)
    return std::nullopt;
  Fit fit;
  const double reference_W = max_reference_m / settings.dc_gain_m_per_W;
  fit.at_most("arithmetic", reference_W, signal);
  fit.at_most("arithmetic", max_W, signal);
  for (const double coefficient : settings.model.denominator)
    fit.at_most("arithmetic", coefficient, state);
  if (settings.kind == ControllerKind::pi) {
    fit.at_most("proportional_W_per_m", settings.pi.proportional_W_per_m * settings.dc_gain_m_per_W,
                signal);
    fit.at_most("integral_W_per_m_s", settings.pi.integral_W_per_m_s * settings.dc_gain_m_per_W,
                signal);
  } else if (settings.kind == ControllerKind::pd_ff) {
    const PdFeedforwardSettings& pd = settings.pd_ff;
    fit.at_most("proportional_W_per_m", pd.proportional_W_per_m * settings.dc_gain_m_per_W, signal);
    fit.at_most("derivative_Ws_per_m", pd.derivative_Ws_per_m * settings.dc_gain_m_per_W, signal);
    fit.at_most("feedforward_W_per_m", pd.feedforward_W_per_m * settings.dc_gain_m_per_W, signal);
    fit.at_most("derivative_filter_rad_per_s",
                pd.derivative_filter_rad_per_s * pd.derivative_filter_rad_per_s, state);
  } else if (settings.kind == ControllerKind::adaptive_ff) {
    const AdaptiveFeedforwardSettings& a = settings.adaptive_ff;
    const Theta units = a.scale.nominal * a.scale.dc_gain_m_per_W;
    fit.at_most("bandwidth_rad_per_s", a.bandwidth_rad_per_s * std::max(units[1], units[2]),
                signal);
    fit.at_most("bandwidth_rad_per_s", a.bandwidth_rad_per_s * units[3] * step_s, state);
    fit.at_most("derivative_filter_rad_per_s",
                a.derivative_filter_rad_per_s * a.derivative_filter_rad_per_s, state);
  } else if (settings.kind == ControllerKind::mrac) {
    check_mrac(fit, settings.mrac, step_s, std::max(reference_W, max_W));
  }
  return fit.violation();
}

std::optional<Violation> check_fit(const EstimatorSettings& settings, double step_s, double max_W) {
  if (settings.arithmetic != Arithmetic::q8_24 || settings.kind == EstimatorKind::none)
    return std::nullopt;
  Fit fit;
  fit.at_most("arithmetic", max_W, signal);
  if (settings.kind != EstimatorKind::gradient) return fit.violation();
  const GradientSettings& g = settings.gradient;
  const Theta& nominal = g.scale.nominal;
  for (int i = 0; i < 4; ++i) {
    fit.gain("gain", g.gain[i] / (nominal[i] * nominal[i]) * step_s);
    fit.at_most("initial", g.initial[i] / nominal[i], signal);
    if (g.bounds) {
      fit.at_most("lower", g.bounds->lower[i] / nominal[i], signal);
      fit.at_most("upper", g.bounds->upper[i] / nominal[i], signal);
    }
  }
  fit.at_most("normalisation", g.normalisation, signal);
  return fit.violation();
}

}  // namespace supercoil::control
