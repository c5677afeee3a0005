// Feedforward by what the estimator knows of the muscle, with a fixed PID for the rest.
#pragma once

#include "supercoil/control/estimation/estimate.hpp"
#include "supercoil/control/estimation/parametric_model.hpp"
#include "supercoil/control/tracking/law.hpp"

namespace supercoil::control {

/// u = θ̄1 m̂x⃛m + θ̄2 ẍm + θ̄3 ẋm + θ̄4 xm + θ̄5 + Kp e + Kd ė + Ki ∫e, e = xm − x: the muscle's equation
/// turned round, so that a muscle that is θ̄ follows its model exactly. θ̄ follows the estimate while
/// that is settled, and rests otherwise.
///
/// The PID is fixed: Kp = ωc θ3, Kd = ωc θ2, Ki = ωc θ4 of the nominal muscle, which leaves about
/// ωc/s of the open loop. Estimates fed into it gave errors of 2 to 4 mm after a change of
/// stiffness.
struct AdaptiveFeedforwardSettings {
  RegressionScale scale;  ///< of the nominal muscle; θ̄(0)
  /// ωc. At 8 the loop holds for ±20 % of all six physical parameters at once with 1.5 ms of delay
  /// (adaptive_feedforward_margin_test.cpp).
  double bandwidth_rad_per_s = 8.0;
  double derivative_filter_rad_per_s = 60.0;  ///< of x, twice this pole
  double follow_s = 1.0;                      ///< time constant with which θ̄ follows
};

template <class Scalar>
class AdaptiveFeedforward {
 public:
  using Wide = Accumulator<Scalar>;
  using Parameters = Vector<Wide, 5>;

  AdaptiveFeedforward(const AdaptiveFeedforwardSettings& s, double step_s)
      : settings_(s),
        filter_({s.derivative_filter_rad_per_s * s.derivative_filter_rad_per_s,
                 2.0 * s.derivative_filter_rad_per_s, 1.0},
                step_s),
        filter_gain_(s.derivative_filter_rad_per_s * s.derivative_filter_rad_per_s),
        follow_step_(step_s / s.follow_s) {
    const Theta units = s.scale.nominal * s.scale.dc_gain_m_per_W;
    weights_ << Wide(units[0] * s.scale.moving_mass_kg), Wide(units[1]), Wide(units[2]),
        Wide(units[3]), Wide(1);
    proportional_ = to<Scalar>(s.bandwidth_rad_per_s * units[2]);
    derivative_ = to<Scalar>(s.bandwidth_rad_per_s * units[1]);
    integral_step_ = Wide(s.bandwidth_rad_per_s * units[3] * step_s);
    theta_ << Wide(1), Wide(1), Wide(1), Wide(1), Wide{};
  }

  /// What the estimator tells, once a tick before step().
  void learn(const Estimate& estimate) {
    if (!estimate.settled) return;
    Parameters now;
    now << estimate.theta.cwiseQuotient(settings_.scale.nominal).template cast<Wide>(),
        Wide(estimate.bias_W);
    theta_ += (now - theta_) * follow_step_;
  }

  /// The muscle moves as its model does, and the integral is what the rest leaves of the power.
  void start(const LawStart<Scalar>& at) {
    filter_.settle(at.position, at.model.velocity);
    integral_ = Wide{};
    wanted_ = at.power;
    if (!at.hold) return;
    LawInput<Scalar> now;
    now.position = at.position;
    now.model = at.model;
    integral_ = Wide(at.power - feedforward(now) - feedback(now));
  }

  /// Returns the wanted power. The integrator holds while the power is limited, unless the error
  /// leads out of the limit.
  Scalar step(const LawInput<Scalar>& in) {
    filter_.step(in.position);
    const Scalar error = in.model.position - in.position;
    const bool leads_out = (wanted_ > in.applied) == (error < Scalar(0));
    if (!in.limited || leads_out) integral_ += Wide(error) * integral_step_;
    wanted_ = feedforward(in) + feedback(in) + to<Scalar>(integral_);
    return wanted_;
  }

  static constexpr std::size_t gains = 8;
  GainValue gain(std::size_t i) const {
    const Theta& nominal = settings_.scale.nominal;
    const Vector<double, 5> now = theta_.template cast<double>();
    switch (i) {
      case 0:
        return {Gain::proportional, settings_.bandwidth_rad_per_s * nominal[2]};
      case 1:
        return {Gain::integral, settings_.bandwidth_rad_per_s * nominal[3]};
      case 2:
        return {Gain::derivative, settings_.bandwidth_rad_per_s * nominal[1]};
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
  Scalar feedforward(const LawInput<Scalar>& in) const {
    Parameters motion;
    motion << Wide(in.model_jerk), Wide(in.model.acceleration), Wide(in.model.velocity),
        Wide(in.model.position), Wide(1);
    return to<Scalar>(theta_.cwiseProduct(weights_).dot(motion));
  }

  Scalar feedback(const LawInput<Scalar>& in) const {
    const auto velocity = to<Scalar>(filter_.state()[1] * filter_gain_);
    return (in.model.position - in.position) * proportional_ +
           (in.model.velocity - velocity) * derivative_;
  }

  AdaptiveFeedforwardSettings settings_;
  StateVariableFilter<Scalar, 2, Hold::first_order> filter_;
  Wide filter_gain_;
  Wide follow_step_;
  Parameters weights_;
  Scalar proportional_{};
  Scalar derivative_{};
  Wide integral_step_{};
  Parameters theta_;
  Wide integral_{};
  Scalar wanted_{};
};

}  // namespace supercoil::control
