// A PID with fixed gains, for the errors that a law's own model leaves.
#pragma once

#include <algorithm>

#include "supercoil/control/actuator/parameters.hpp"
#include "supercoil/control/estimation/parametric_model.hpp"
#include "supercoil/control/linear/filter.hpp"
#include "supercoil/control/tracking/law_definition.hpp"

namespace supercoil::control {

/// Maximum of ωc over the mechanics' damping rate. Up to it the open loop with FixedPid is about
/// ωc/s; beyond it a second-order gain falls with the square. A lightly damped muscle (ratio 0.06)
/// limit-cycles at 8 rad/s, but tracks within 0.34 µm at 1 rad/s.
constexpr double max_bandwidth_ratio = 0.36;

/// About µ/m̂ of the muscle: the lag that a FixedPid tuned for it leaves in the open loop.
inline double damping_rate(const Theta& theta, double moving_mass_kg) {
  return theta[1] / (theta[0] * moving_mass_kg);
}

/// ωc of a FixedPid tuned for the muscle.
inline double feedback_bandwidth(double max_rad_per_s, const Theta& theta, double moving_mass_kg) {
  return std::min(max_rad_per_s, max_bandwidth_ratio * damping_rate(theta, moving_mass_kg));
}

/// For laws that cannot do without their FixedPid.
inline void check_bandwidth(LawProblems& problems, double bandwidth_rad_per_s) {
  if (!(bandwidth_rad_per_s >= 0.01)) problems.add({"bandwidth_rad_per_s", "must be 0.01 to 100"});
}

/// Kp e + Kd ė + Ki ∫e, e = xm − x, with Kp = ωc θ3, Kd = ωc θ2, Ki = ωc θ4 of the nominal muscle,
/// or of the one identified since. The open loop is then about ωc/s.
///
/// ė is filtered as a whole. If only ẋ were, its lag would act as an error that no bandwidth
/// removes: 0.6 µm rms on the paper's sine, 2.3 µm on its steps.
template <class Scalar>
class FixedPid {
 public:
  using Wide = Accumulator<Scalar>;

  /// bandwidth: ωc. filter: double pole for the derivative of e. step_s: > 0, in seconds.
  FixedPid(const RegressionScale& scale, double bandwidth_rad_per_s, double filter_rad_per_s,
           double step_s)
      : bandwidth_rad_per_s_(bandwidth_rad_per_s),
        dc_gain_m_per_W_(scale.dc_gain_m_per_W),
        step_s_(step_s),
        slope_(squared_pole(filter_rad_per_s), step_s),
        slope_gain_(filter_rad_per_s * filter_rad_per_s) {
    retune(scale.nominal);
  }

  /// Sets ωc from the next retune() on.
  void set_bandwidth(double rad_per_s) { bandwidth_rad_per_s_ = rad_per_s; }

  /// Gains for a muscle other than the nominal one, in the same units. Not while the law runs.
  void retune(const Theta& theta) {
    gains_ = theta * bandwidth_rad_per_s_;
    ratio_ = 1.0;
    const Theta units = gains_ * dc_gain_m_per_W_;
    tuned_proportional_ = proportional_ = to<Scalar>(units[2]);
    tuned_derivative_ = derivative_ = to<Scalar>(units[1]);
    tuned_integral_step_ = integral_step_ = Wide(units[3] * step_s_);
  }

  /// The loop oscillates: lowers the gains until another muscle is identified.
  void slow_down() {
    gains_ *= oscillation_gain_ratio;
    tuned_proportional_ = tuned_proportional_ * to<Scalar>(oscillation_gain_ratio);
    tuned_derivative_ = tuned_derivative_ * to<Scalar>(oscillation_gain_ratio);
    tuned_integral_step_ = tuned_integral_step_ * Wide(oscillation_gain_ratio);
    schedule(Scalar(1));
  }

  /// From now on all gains are `ratio` times those tuned for the muscle.
  void schedule(Scalar ratio) {
    ratio_ = static_cast<double>(ratio);
    proportional_ = tuned_proportional_ * ratio;
    derivative_ = tuned_derivative_ * ratio;
    integral_step_ = tuned_integral_step_ * Wide(ratio);
  }

  /// Settles as if the muscle had long moved like the model, at this distance; zero integral.
  void start(const LawStart<Scalar>& at) {
    slope_.settle(at.model.position - at.position);
    integral_ = Wide{};
    demanded_ = at.power;
  }
  /// Sets the integral to the power less the rest and the feedback at the start's motion.
  void hold(const LawInput<Scalar>& at, Scalar power, Scalar rest) {
    integral_ = Wide(power - rest - feedback(at));
  }

  /// Returns the demanded power: the rest plus the PID's. The integrator holds while the power is
  /// limited, unless the error leads out of the limit.
  Scalar step(const LawInput<Scalar>& in, Scalar rest) {
    const Scalar e = error(in);
    const bool leads_out = (demanded_ > in.applied) == (e < Scalar(0));
    if (!in.limited || leads_out) integral_ += Wide(e) * integral_step_;
    demanded_ = rest + feedback(in) + to<Scalar>(integral_);
    return demanded_;
  }
  /// From now on the rest gives this much more, and the integral that much less.
  void hand_over_to_feedforward(Wide power) { integral_ -= power; }
  /// What the last step demanded.
  Scalar demanded() const { return demanded_; }
  /// Call once a tick, before step().
  void update_derivative(const LawInput<Scalar>& in) { slope_.step(error(in)); }

  static constexpr std::size_t gains = 3;
  GainValue gain(std::size_t i) const {
    if (i == 0) return {Gain::proportional, ratio_ * gains_[2]};
    if (i == 1) return {Gain::integral, ratio_ * gains_[3]};
    return {Gain::derivative, ratio_ * gains_[1]};
  }

 private:
  static Scalar error(const LawInput<Scalar>& in) { return in.model.position - in.position; }
  Scalar feedback(const LawInput<Scalar>& in) const {
    const auto rate = to<Scalar>(slope_.state()[1] * slope_gain_);
    return error(in) * proportional_ + rate * derivative_;
  }

  double bandwidth_rad_per_s_;
  double dc_gain_m_per_W_;
  double step_s_;
  Theta gains_;         // tuned for the muscle
  double ratio_ = 1.0;  // of the gains in use over those
  StateVariableFilter<Scalar, 2, Hold::first_order> slope_;
  Wide slope_gain_;
  Scalar tuned_proportional_{};
  Scalar tuned_derivative_{};
  Wide tuned_integral_step_{};
  Scalar proportional_{};
  Scalar derivative_{};
  Wide integral_step_{};
  Wide integral_{};
  Scalar demanded_{};
};

}  // namespace supercoil::control
