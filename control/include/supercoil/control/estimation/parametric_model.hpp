// The muscle's dynamics as a regression that needs no derivative of a measurement.
#pragma once

#include "supercoil/control/actuator/parameters.hpp"
#include "supercoil/control/linear/filter.hpp"

namespace supercoil::control {

/// The units of the regressors. Position is taken in watts at rest (divided by the muscle's DC
/// gain) and every regressor is multiplied by its nominal parameter, so that all unknowns are near
/// 1 and fixed point has its full resolution.
struct RegressionScale {
  Theta nominal{18.837, 38.606, 322.09, 165.58};  ///< the paper's θ*, docs/paper.md
  double dc_gain_m_per_W = 0.0060393;             ///< the paper's actuator
  double moving_mass_kg = 0.09;
};

/// Λ(s) = s³ + 6s² + 9s + 10, ascending (paper, Sec. 5.1).
inline constexpr Polynomial<3> paper_lambda{10.0, 9.0, 6.0, 1.0};

/// z = P/Λ and φ = [m̂s³X, s²X, sX, X]/Λ (paper, Eq. (3), errata), φ in the units of its scale.
template <class Scalar>
class ParametricModel {
 public:
  using Regressors = Vector<Scalar, 4>;

  ParametricModel(const Polynomial<3>& lambda, const RegressionScale& scale, double step_s)
      : power_(lambda, step_s), position_(lambda, step_s) {
    const Theta units = scale.nominal * scale.dc_gain_m_per_W;
    weights_ = Theta{units[0] * scale.moving_mass_kg, units[1], units[2], units[3]}
                   .template cast<Accumulator<Scalar>>();
  }

  /// position_W: this tick's position over the DC gain. applied_power_W: the power really applied
  /// since the last tick.
  void step(Scalar position_W, Scalar applied_power_W) {
    stepped_ = true;
    if (settles_) settle(position_W);
    power_.step(applied_power_W);
    position_.step(position_W);
    z_ = to<Scalar>(power_.state()[0]);
    const auto& x = position_.state();
    phi_[0] = to<Scalar>(position_.highest_derivative(position_W) * weights_[0]);
    phi_[1] = to<Scalar>(x[2] * weights_[1]);
    phi_[2] = to<Scalar>(x[1] * weights_[2]);
    phi_[3] = to<Scalar>(x[0] * weights_[3]);
  }

  /// The next step settles the filters as if a nominal muscle had long been held where it is then.
  void restart() {
    settles_ = true;
    z_ = Scalar{};
    phi_ = Regressors::Zero();
  }

  bool has_stepped() const { return stepped_; }
  Scalar z() const { return z_; }
  const Regressors& phi() const { return phi_; }

 private:
  void settle(Scalar position_W) {
    power_.settle(position_W);
    position_.settle(position_W);
    settles_ = false;
  }

  bool stepped_ = false;
  bool settles_ = false;  ///< at the next step
  StateVariableFilter<Scalar, 3, Hold::zero_order> power_;
  StateVariableFilter<Scalar, 3, Hold::first_order> position_;
  Vector<Accumulator<Scalar>, 4> weights_;
  Scalar z_{};
  Regressors phi_ = Regressors::Zero();
};

}  // namespace supercoil::control
