// Proportional-integral control (Sun & Zhao 2020, as the paper compares it).
#pragma once

#include <array>

#include "supercoil/control/tracking/law_definition.hpp"

namespace supercoil::control {

/// u = Kp e + Ki ∫e, e = xm − x.
struct PiSettings {
  double proportional_W_per_m = 2000.0;
  double integral_W_per_m_s = 1100.0;
};

/// The law of PiSettings. Positions and powers are in watts at rest (LawInput).
template <class Scalar>
class Pi {
 public:
  /// dc_gain_m_per_W: metres per watt of the law's own unit.
  Pi(const PiSettings& settings, double dc_gain_m_per_W, double step_s)
      : settings_(settings), dc_gain_m_per_W_(dc_gain_m_per_W), step_s_(step_s) {
    scale_feedback(1.0);
  }

  /// To hold a power, the integral becomes that power less the proportional term; otherwise zero.
  void start(const LawStart<Scalar>& at) {
    demanded_ = at.hold ? at.power : Scalar{};
    integral_ = Accumulator<Scalar>(demanded_ - (at.model.position - at.position) * proportional_);
    if (!at.hold) integral_ = {};
  }

  void slow_down() { scale_feedback(ratio_ * oscillation_gain_ratio); }
  /// The muscle was identified: the configured gains apply again. Not while the law runs.
  void retune(const Theta&) { scale_feedback(1.0); }

  /// Returns the demanded power. The integrator holds while the power is limited, unless the error
  /// leads out of the limit.
  Scalar step(const LawInput<Scalar>& in) {
    const Scalar error = in.model.position - in.position;
    const bool leads_out = (demanded_ > in.applied) == (error < Scalar(0));
    if (!in.limited || leads_out) {
      integral_ += Accumulator<Scalar>(error) * integral_step_;
    }
    demanded_ = error * proportional_ + to<Scalar>(integral_);
    return demanded_;
  }

  static constexpr std::size_t gains = 2;
  GainValue gain(std::size_t i) const {
    if (i == 0) return {Gain::proportional, ratio_ * settings_.proportional_W_per_m};
    return {Gain::integral, ratio_ * settings_.integral_W_per_m_s};
  }

 private:
  void scale_feedback(double ratio) {
    ratio_ = ratio;
    proportional_ = to<Scalar>(ratio * settings_.proportional_W_per_m * dc_gain_m_per_W_);
    integral_step_ =
        Accumulator<Scalar>(ratio * settings_.integral_W_per_m_s * dc_gain_m_per_W_ * step_s_);
  }

  PiSettings settings_;
  double dc_gain_m_per_W_;
  double step_s_;
  double ratio_ = 1.0;  // of the gains in use over the configured ones
  Scalar proportional_{};
  Accumulator<Scalar> integral_step_{};
  Accumulator<Scalar> integral_{};
  Scalar demanded_{};
};

/// `pi`: how Pi is named, set, made and checked (LawDefinition).
struct PiLaw : LawDefaults {
  using Settings = PiSettings;
  template <class Scalar>
  using In = Pi<Scalar>;
  static constexpr std::string_view name = "pi";
  static constexpr std::array values{
      setting_value<Settings, &Settings::proportional_W_per_m>("proportional_W_per_m"),
      setting_value<Settings, &Settings::integral_W_per_m_s>("integral_W_per_m_s")};

  template <class Scalar>
  static Pi<Scalar> make(const Settings& s, const LawContext& context, double step_s) {
    return {s, context.dc_gain_m_per_W, step_s};
  }
  static std::optional<FixedLaw> fixed_law(const Settings& s, const LawContext&,
                                           const PhysicalParameters&) {
    return FixedLaw{s.proportional_W_per_m, s.integral_W_per_m_s};
  }
  static void check_fit(FixedPointFit& fit, const Settings& s, const LawContext& context,
                        double /*step_s*/, double /*peak_W*/) {
    const double unit = context.dc_gain_m_per_W;
    fit.at_most("proportional_W_per_m", s.proportional_W_per_m * unit, FixedPointFit::signal);
    fit.at_most("integral_W_per_m_s", s.integral_W_per_m_s * unit, FixedPointFit::signal);
  }
};

}  // namespace supercoil::control
