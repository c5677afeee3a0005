// Watches a muscle for changes with the estimator's own equation, through faster filters.
#pragma once

#include <algorithm>
#include <optional>

#include "supercoil/control/estimation/change_detector.hpp"
#include "supercoil/control/estimation/filtered_regression.hpp"

namespace supercoil::control {

/// Λ(s) = (s + 18)⁵. A change moves the muscle at once, while the error of the linear equation
/// comes as slowly as the motion: the faster the filters, the better the two are told apart. On the
/// muscle `real_hard` (15 % of hysteresis) a stiffness lower by a quarter is detected within 0.32 s
/// at all of 16 phases of the sine; with poles at 8 rad/s it was missed at 5. Beyond 20 the
/// position's noise shows on slow muscles.
inline constexpr double watch_pole_rad_per_s = 18.0;

/// A ChangeDetector on the residual P − θᵀφ, both through 1/Λ.
template <class Scalar>
class ChangeWatch {
 public:
  /// θ over nominal, then the bias in W.
  using Parameters = Vector<double, 5>;
  /// What a change does to θ: k scales θ3 and θ4, γ all four, a load adds power, η scales θ4.
  enum Direction : int { stiffness, power_gain, load, cooling, directions };
  using Directions = Matrix<double, 5, directions>;

  /// max_W: > 0, the largest power. step_s: between ticks; period_s: between updates.
  ChangeWatch(const RegressionScale& scale, double max_W, double step_s, double period_s)
      : power_(lambda(), step_s),
        position_(lambda(), step_s),
        detector_(settings_for(scale, max_W, period_s)),
        settling_updates_(std::llround(settling_s / period_s)) {
    const double pole = watch_pole_rad_per_s;
    gain_ = pole * pole * pole * pole * pole;
    const Theta units = scale.nominal * scale.dc_gain_m_per_W;
    weights_ = Theta{units[0] * scale.moving_mass_kg, units[1], units[2], units[3]} * gain_;
  }

  /// The muscle is heated again after a pause.
  void restart(Scalar position_W) {
    power_.settle(Scalar{});
    position_.settle(position_W);
    detector_.forget_window();
    settling_ = settling_updates_;
  }

  /// One tick: this tick's position in watts at rest, and the power applied since the last one.
  void step(Scalar position_W, Scalar applied_power_W) {
    power_.step(applied_power_W);
    position_.step(position_W);
  }

  /// Whether the muscle has changed from what is known of it, theta.
  bool update(const Parameters& theta) {
    if (settling_ > 0) {
      --settling_;
      return false;
    }
    const auto x = position_.state().template cast<double>().eval();
    Parameters phi;
    phi << x[3] * weights_[0], x[2] * weights_[1], x[1] * weights_[2], x[0] * weights_[3], 1.0;
    const double residual_W = static_cast<double>(power_.state()[0]) * gain_ - theta.dot(phi);
    const typename Detector::Signals signals = along(theta).transpose() * phi;
    if (!detector_.step(signals, residual_W)) return false;
    detector_.forget_window();
    return true;
  }

  /// The directions as columns, in the order of their names.
  static Directions along(const Parameters& theta) {
    Directions d = Directions::Zero();
    d.col(stiffness).template segment<2>(2) = theta.template segment<2>(2);
    d.col(power_gain).template head<4>() = theta.template head<4>();
    d(4, load) = 1.0;
    d(3, cooling) = theta[3];
    return d;
  }

 private:
  using Detector = ChangeDetector<directions>;

  /// Residual (rms) that a change must exceed, over max_W.
  static constexpr double floor_ratio = 0.0027;
  /// Time in which the filters forget their initial state.
  static constexpr double settling_s = 3.0;

  static constexpr Polynomial<5> lambda() {
    constexpr double p = watch_pole_rad_per_s;
    return {p * p * p * p * p, 5.0 * p * p * p * p, 10.0 * p * p * p, 10.0 * p * p, 5.0 * p, 1.0};
  }

  static typename Detector::Settings settings_for(const RegressionScale& scale, double max_W,
                                                  double period_s) {
    const double slow = slowness(scale.nominal);
    typename Detector::Settings s{.period_s = period_s,
                                  .floor_rms = floor_ratio * max_W,
                                  .window_s = 0.4,
                                  .ratio = 6.0};  // the measured motion is noisy
    s.stretch(slow);
    // Motions are no faster on a fast muscle than on the usual one.
    s.memory_s *= std::max(1.0, slow);
    s.blind_s *= std::max(1.0, slow);
    return s;
  }

  StateVariableFilter<Scalar, 5, Hold::zero_order> power_;
  StateVariableFilter<Scalar, 5, Hold::first_order> position_;
  Detector detector_;
  std::int64_t settling_updates_;
  std::int64_t settling_ = 0;
  double gain_;
  Theta weights_;
};

}  // namespace supercoil::control
