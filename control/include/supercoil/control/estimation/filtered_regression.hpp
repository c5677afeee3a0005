// The muscle's equation with a power bias, filtered steeply enough for noisy positions.
#pragma once

#include "supercoil/control/estimation/parametric_model.hpp"

namespace supercoil::control {

/// Λ'(s) = (s³ + 6s² + 9s + 10)(s/8 + 1)², made monic by its gain of 64. Two poles more than the
/// paper's Λ: otherwise the regressor of θ1, s³X/Λ, is as noisy as the position.
inline constexpr Polynomial<5> steep_lambda{640.0, 736.0, 538.0, 169.0, 22.0, 1.0};
inline constexpr double steep_lambda_gain = 64.0;

/// z = P/Λ' = θᵀφ with, in this order,
///   φ = [free responses of s², s, 1 over Λ'; m̂s³X/Λ', s²X/Λ', sX/Λ', X/Λ'; 1/Λ']
/// in the units of its scale. The free responses are what the muscle's motion *before* the filters
/// started leaves in them: the derivatives' initial values enter as a polynomial of second degree.
/// The last regressor carries a constant power bias in watts, and settles at 1/Λ'(0) = 1/10.
template <class Scalar>
class FilteredRegression {
 public:
  static constexpr int free = 3;  ///< number of free responses, which come first
  static constexpr int size = free + 4 + 1;
  using Regressors = Vector<Scalar, size>;
  using Derivatives = Vector<double, 5>;

  /// step_s: between ticks; update_s: between regressions, a multiple of step_s.
  FilteredRegression(const RegressionScale& scale, double step_s, double update_s)
      : power_(steep_lambda, step_s),
        position_(steep_lambda, step_s),
        bias_(steep_lambda, update_s),
        free_(steep_lambda, update_s) {
    const Theta units = scale.nominal * scale.dc_gain_m_per_W;
    weights_ =
        (Theta{units[0] * scale.moving_mass_kg, units[1], units[2], units[3]} * steep_lambda_gain)
            .template cast<Accumulator<Scalar>>();
  }

  /// Starts the filters at rest. The muscle is at this position, and may be moving.
  void restart(Scalar position_W) {
    power_.settle(Scalar{});
    bias_.settle(Scalar{});
    State rest = State::Zero();
    position_.set(rest, position_W);
    rest[4] = Accumulator<Scalar>(1);  // what an impulse leaves
    free_.set(rest, Scalar{});
  }

  /// One tick: this tick's position over the DC gain, and the power applied since the last one.
  void step(Scalar position_W, Scalar applied_power_W) {
    power_.step(applied_power_W);
    position_.step(position_W);
  }

  /// z and φ of this tick; once every update_s.
  void update() {
    bias_.step(Scalar(1));
    free_.step(Scalar{});
    const auto gain = Accumulator<Scalar>(steep_lambda_gain);
    z_ = to<Scalar>(power_.state()[0] * gain);
    const auto& x = position_.state();
    const auto& g = free_.state();
    phi_ << to<Scalar>(g[2] * gain), to<Scalar>(g[1] * gain), to<Scalar>(g[0] * gain),
        to<Scalar>(x[3] * weights_[0]), to<Scalar>(x[2] * weights_[1]),
        to<Scalar>(x[1] * weights_[2]), to<Scalar>(x[0] * weights_[3]),
        to<Scalar>(bias_.state()[0] * gain);
  }

  Scalar z() const { return z_; }
  const Regressors& phi() const { return phi_; }
  /// [1, s, s², s³, s⁴]/Λ' of an impulse, and of a constant 1, since the restart.
  Derivatives impulse_response() const { return derivatives(free_); }
  Derivatives step_response() const { return derivatives(bias_); }

 private:
  using Held = StateVariableFilter<Scalar, 5, Hold::zero_order>;
  using State = typename Held::State;

  static Derivatives derivatives(const Held& filter) {
    return filter.state().template cast<double>() * steep_lambda_gain;
  }

  Held power_;
  StateVariableFilter<Scalar, 5, Hold::first_order> position_;
  Held bias_;
  Held free_;
  Vector<Accumulator<Scalar>, 4> weights_;
  Scalar z_{};
  Regressors phi_ = Regressors::Zero();
};

}  // namespace supercoil::control
