// Feedforward from the estimated muscle, with a fixed PID for the rest.
#pragma once

#include <algorithm>
#include <array>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/estimation/estimate.hpp"
#include "supercoil/control/tracking/fixed_pid.hpp"

namespace supercoil::control {

/// u = θ̄1 m̂x⃛m + θ̄2 ẍm + θ̄3 ẋm + θ̄4 xm + θ̄5 + Kp e + Kd ė + Ki ∫e, e = xm − x: the inverse of
/// the muscle's equation, so that a muscle with parameters θ̄ follows its model exactly. θ̄ follows
/// the estimate while that is settled, and rests otherwise.
///
/// The PID is fixed: Kp = ωc θ3, Kd = ωc θ2, Ki = ωc θ4 of the nominal muscle, so the open loop is
/// about ωc/s. Using estimates in it gave errors of 2 to 4 mm after a change of stiffness.
struct AdaptiveFeedforwardSettings {
  RegressionScale scale;  ///< of the nominal muscle; θ̄(0)
  /// ωc. At 8 the loop tolerates ±20 % of all six physical parameters at once with 1.5 ms of delay
  /// (loop_margin_test.cpp).
  double bandwidth_rad_per_s = 8.0;
  double derivative_filter_rad_per_s = 60.0;  ///< of the error, twice this pole
  double follow_s = 0.5;                      ///< time constant with which θ̄ follows
};

/// The law of AdaptiveFeedforwardSettings. Positions and powers are in watts at rest (LawInput); it
/// does not saturate its output.
template <class Scalar>
class AdaptiveFeedforward {
 public:
  using Wide = Accumulator<Scalar>;
  using Parameters = Vector<Wide, 5>;

  AdaptiveFeedforward(const AdaptiveFeedforwardSettings& s, double step_s)
      : settings_(s),
        pid_(s.scale, s.bandwidth_rad_per_s, s.derivative_filter_rad_per_s, step_s),
        follow_step_(step_s / s.follow_s) {
    const Theta units = s.scale.nominal * s.scale.dc_gain_m_per_W;
    weights_ << Wide(units[0] * s.scale.moving_mass_kg), Wide(units[1]), Wide(units[2]),
        Wide(units[3]), Wide(1);
    theta_ << Wide(1), Wide(1), Wide(1), Wide(1), Wide{};
  }

  /// The muscle was identified: sets θ̄ and the PID's gains to its own; the bias stays. Not while
  /// the law runs.
  void retune(const Theta& theta) {
    pid_.retune(theta);
    const Theta relative = theta.cwiseQuotient(settings_.scale.nominal);
    theta_.template head<4>() = relative.template cast<Wide>();
  }

  /// Takes the estimate; call once a tick before step().
  void learn(const Estimate& estimate) {
    if (!estimate.settled) return;
    Parameters now;
    now << estimate.theta.cwiseQuotient(settings_.scale.nominal).template cast<Wide>(),
        Wide(estimate.bias_W);
    const Parameters change = (now - theta_) * follow_step_;
    theta_ += change;
    // The feedforward takes this power over from the integral.
    pid_.hand_over_to_feedforward(change.cwiseProduct(weights_).dot(motion_));
  }

  /// Starts with the muscle moving like its model. To hold a power, the integral becomes that power
  /// less the rest; otherwise zero.
  void start(const LawStart<Scalar>& at) {
    pid_.start(at);
    motion_ = Parameters::Zero();
    if (!at.hold) return;
    LawInput<Scalar> now;
    now.position = at.position;
    now.model = at.model;
    pid_.hold(now, at.power, feedforward(motion_of(now)));
  }

  void slow_down() { pid_.slow_down(); }

  /// Returns the demanded power.
  Scalar step(const LawInput<Scalar>& in) {
    pid_.update_derivative(in);
    motion_ = motion_of(in);
    return pid_.step(in, feedforward(motion_));
  }

  static constexpr std::size_t gains = FixedPid<Scalar>::gains + 5;
  GainValue gain(std::size_t i) const {
    const Theta& nominal = settings_.scale.nominal;
    const Vector<double, 5> now = theta_.template cast<double>();
    if (i < FixedPid<Scalar>::gains) return pid_.gain(i);
    switch (i) {
      case 3:
        return {Gain::feedforward, now[3] * nominal[3]};
      case 4:
        return {Gain::feedforward_velocity, now[2] * nominal[2]};
      case 5:
        return {Gain::feedforward_acceleration, now[1] * nominal[1]};
      case 6:
        return {Gain::feedforward_jerk, now[0] * nominal[0] * settings_.scale.moving_mass_kg};
      default:
        return {Gain::bias, now[4]};
    }
  }

  /// θ̄ over nominal, and its bias in W.
  const Parameters& theta() const { return theta_; }

 private:
  static Parameters motion_of(const LawInput<Scalar>& in) {
    Parameters motion;
    motion << Wide(in.model_jerk), Wide(in.model.acceleration), Wide(in.model.velocity),
        Wide(in.model.position), Wide(1);
    return motion;
  }
  Scalar feedforward(const Parameters& motion) const {
    return to<Scalar>(theta_.cwiseProduct(weights_).dot(motion));
  }

  AdaptiveFeedforwardSettings settings_;
  FixedPid<Scalar> pid_;
  Wide follow_step_;
  Parameters weights_;
  Parameters theta_;
  Parameters motion_ = Parameters::Zero();  ///< the model's, at the last tick
};

/// `adaptive_ff`: how AdaptiveFeedforward is named, set, made and checked (LawDefinition).
struct AdaptiveFeedforwardLaw : LawDefaults {
  using Settings = AdaptiveFeedforwardSettings;
  template <class Scalar>
  using In = AdaptiveFeedforward<Scalar>;
  static constexpr std::string_view name = "adaptive_ff";
  static constexpr std::array values{
      setting_value<Settings, &Settings::bandwidth_rad_per_s>("bandwidth_rad_per_s"),
      setting_value<Settings, &Settings::derivative_filter_rad_per_s>(
          "derivative_filter_rad_per_s"),
      setting_value<Settings, &Settings::follow_s>("follow_s")};

  template <class Scalar>
  static AdaptiveFeedforward<Scalar> make(const Settings& s, const LawContext&, double step_s) {
    return {s, step_s};
  }
  static std::optional<FixedLaw> fixed_law(const Settings& s, const LawContext&,
                                           const PhysicalParameters& muscle) {
    return fixed_pid_law(theta_from(muscle), s.bandwidth_rad_per_s, s.derivative_filter_rad_per_s);
  }
  static void add_contradictions(LawProblems& problems, const Settings& s, const LawContext&) {
    check_bandwidth(problems, s.bandwidth_rad_per_s);
  }
  static void set_nominal(Settings& s, const RegressionScale& scale, double /*max_W*/) {
    s.scale = scale;
  }
  static void check_fit(FixedPointFit& fit, const Settings& s, const LawContext&, double step_s,
                        double /*peak_W*/) {
    const Theta units = s.scale.nominal * s.scale.dc_gain_m_per_W;
    fit.at_most("bandwidth_rad_per_s", s.bandwidth_rad_per_s * std::max(units[1], units[2]),
                FixedPointFit::signal);
    fit.at_most("bandwidth_rad_per_s", s.bandwidth_rad_per_s * units[3] * step_s,
                FixedPointFit::state);
    fit.at_most("derivative_filter_rad_per_s",
                s.derivative_filter_rad_per_s * s.derivative_filter_rad_per_s,
                FixedPointFit::state);
  }
};

}  // namespace supercoil::control
