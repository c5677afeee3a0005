// Proportional-derivative control with feedforward (Yip & Niemeyer 2017, as the paper compares it).
#pragma once

#include <array>

#include "supercoil/control/tracking/law_definition.hpp"

namespace supercoil::control {

/// u = Kp e + Kd (ẋm − ẋf) + Kf xm, e = xm − x, xf = x/(s/ω + 1)².
struct PdFeedforwardSettings {
  double proportional_W_per_m = 2000.0;
  double derivative_Ws_per_m = 300.0;
  double feedforward_W_per_m = 165.58;  ///< ηϱ/γ: the power that holds a metre
  double derivative_filter_rad_per_s = 60.0;
};

/// The law of PdFeedforwardSettings. Positions and powers are in watts at rest (LawInput).
template <class Scalar>
class PdFeedforward {
 public:
  PdFeedforward(const PdFeedforwardSettings& settings, double dc_gain_m_per_W, double step_s)
      : settings_(settings),
        filter_(squared_pole(settings.derivative_filter_rad_per_s), step_s),
        filter_gain_(settings.derivative_filter_rad_per_s * settings.derivative_filter_rad_per_s),
        dc_gain_m_per_W_(dc_gain_m_per_W),
        feedforward_(to<Scalar>(settings.feedforward_W_per_m * dc_gain_m_per_W)) {
    scale_feedback(1.0);
  }

  /// Starts with the model's velocity: a filter that started at rest would see a jump of speed.
  void start(const LawStart<Scalar>& at) { filter_.settle(at.position, at.model.velocity); }

  void slow_down() { scale_feedback(ratio_ * oscillation_gain_ratio); }
  /// The muscle was identified: the configured gains apply again. Not while the law runs.
  void retune(const Theta&) { scale_feedback(1.0); }

  /// Returns the demanded power.
  Scalar step(const LawInput<Scalar>& in) {
    filter_.step(in.position);
    const auto velocity = to<Scalar>(filter_.state()[1] * filter_gain_);
    return (in.model.position - in.position) * proportional_ +
           (in.model.velocity - velocity) * derivative_ + in.model.position * feedforward_;
  }

  static constexpr std::size_t gains = 3;
  GainValue gain(std::size_t i) const {
    if (i == 0) return {Gain::proportional, ratio_ * settings_.proportional_W_per_m};
    if (i == 1) return {Gain::derivative, ratio_ * settings_.derivative_Ws_per_m};
    return {Gain::feedforward, settings_.feedforward_W_per_m};
  }

 private:
  void scale_feedback(double ratio) {
    ratio_ = ratio;
    proportional_ = to<Scalar>(ratio * settings_.proportional_W_per_m * dc_gain_m_per_W_);
    derivative_ = to<Scalar>(ratio * settings_.derivative_Ws_per_m * dc_gain_m_per_W_);
  }

  PdFeedforwardSettings settings_;
  StateVariableFilter<Scalar, 2, Hold::first_order> filter_;
  Accumulator<Scalar> filter_gain_;
  double dc_gain_m_per_W_;
  double ratio_ = 1.0;  // of the feedback's gains in use over the configured ones
  Scalar proportional_{};
  Scalar derivative_{};
  Scalar feedforward_;
};

/// `pd_ff`: how PdFeedforward is named, set, made and checked (LawDefinition).
struct PdFeedforwardLaw : LawDefaults {
  using Settings = PdFeedforwardSettings;
  template <class Scalar>
  using In = PdFeedforward<Scalar>;
  static constexpr std::string_view name = "pd_ff";
  static constexpr std::array values{
      setting_value<Settings, &Settings::proportional_W_per_m>("proportional_W_per_m"),
      setting_value<Settings, &Settings::derivative_Ws_per_m>("derivative_Ws_per_m"),
      setting_value<Settings, &Settings::feedforward_W_per_m>("feedforward_W_per_m"),
      setting_value<Settings, &Settings::derivative_filter_rad_per_s>(
          "derivative_filter_rad_per_s")};

  template <class Scalar>
  static PdFeedforward<Scalar> make(const Settings& s, const LawContext& context, double step_s) {
    return {s, context.dc_gain_m_per_W, step_s};
  }
  static std::optional<FixedLaw> fixed_law(const Settings& s, const LawContext&,
                                           const PhysicalParameters&) {
    return FixedLaw{s.proportional_W_per_m, 0.0, s.derivative_Ws_per_m,
                    s.derivative_filter_rad_per_s};
  }
  static void set_nominal(Settings& s, const RegressionScale& scale, double /*max_W*/) {
    s.feedforward_W_per_m = 1.0 / scale.dc_gain_m_per_W;
  }
  static void check_fit(FixedPointFit& fit, const Settings& s, const LawContext& context,
                        double /*step_s*/, double /*peak_W*/) {
    const double unit = context.dc_gain_m_per_W;
    fit.at_most("proportional_W_per_m", s.proportional_W_per_m * unit, FixedPointFit::signal);
    fit.at_most("derivative_Ws_per_m", s.derivative_Ws_per_m * unit, FixedPointFit::signal);
    fit.at_most("feedforward_W_per_m", s.feedforward_W_per_m * unit, FixedPointFit::signal);
    fit.at_most("derivative_filter_rad_per_s",
                s.derivative_filter_rad_per_s * s.derivative_filter_rad_per_s,
                FixedPointFit::state);
  }
};

}  // namespace supercoil::control
