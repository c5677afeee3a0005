// The motion that a controller makes the muscle follow.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "supercoil/control/linear/filter.hpp"

namespace supercoil::control {

/// The model's motion at one tick; position and its time derivatives in the reference's unit.
template <class Scalar>
struct ModelMotion {
  Scalar position{};
  Scalar velocity{};
  Scalar acceleration{};
};

/// A trajectory's motion at a time.
struct TrajectoryPoint {
  ModelMotion<double> motion;  ///< m, m/s, m/s²
  double jerk = 0.0;           ///< m/s³
};

/// Wm(s) = gain/denominator, third order, of relative degree three like the muscle.
struct ReferenceModelSettings {
  Polynomial<3> denominator;  ///< monic, Hurwitz, ascending
  double gain;                ///< > 0; equal to denominator[0] for a DC gain of 1
  /// Real poles are at −poles_rad_per_s[i]; NaN when they are complex.
  std::array<double, 3> poles_rad_per_s{NAN, NAN, NAN};

  /// The default model by itself would need seconds to come back to a trajectory.
  static constexpr double min_leading_rad_per_s = 5.0;

  double dc_gain() const { return gain / denominator[0]; }
  /// The reference, in m, under which a model in this motion converges to another one and then
  /// follows it. The deviation decays with three poles at min_leading_rad_per_s, or at the model's
  /// own if these are faster.
  double reference_for(const TrajectoryPoint& to, const ModelMotion<double>& model) const {
    const Polynomial<3>& a = denominator;
    const double pole = std::fmax(min_leading_rad_per_s, std::cbrt(a[0]));
    const double jerk = to.jerk + 3.0 * pole * (to.motion.acceleration - model.acceleration) +
                        3.0 * pole * pole * (to.motion.velocity - model.velocity) +
                        pole * pole * pole * (to.motion.position - model.position);
    return (jerk + a[2] * model.acceleration + a[1] * model.velocity + a[0] * model.position) /
           gain;
  }
};

/// ωn²q0/((s² + 2ζωn s + ωn²)(s + q0)) with ωn = 1 rad/s, ζ = 0.69, q0 = 0.8: what the paper's text
/// asks for (less than 5 % of overshoot). The default.
ReferenceModelSettings design_model();
/// 1/(s³ + s² + 1.38 s + 1): what the paper prints as Eq. (8); 40 % of overshoot.
ReferenceModelSettings eq8_model();
/// 16/((s + 4)(s + 5)(s + 0.8)): the model that makes Eq. (12) hold for p0 = 4, p1 = 5, q0 = 0.8.
ReferenceModelSettings wm16_model();
/// Three real poles at −poles[i] rad/s (each > 0), DC gain 1.
ReferenceModelSettings poles_model(const std::array<double, 3>& poles);
/// "design", "eq8" or "wm16"; empty for any other name.
std::optional<ReferenceModelSettings> reference_model_named(std::string_view name);

/// The model in one arithmetic, exactly discretised for a reference held over each tick. It starts
/// at rest at zero.
template <class Scalar>
class ReferenceModel {
 public:
  ReferenceModel(const ReferenceModelSettings& settings, double step_s)
      : filter_(settings.denominator, step_s), gain_(settings.gain) {}

  /// Continues from another model's motion.
  void set(const ModelMotion<Scalar>& motion) {
    using Wide = Accumulator<Scalar>;
    const typename decltype(filter_)::State state{Wide(motion.position) / gain_,
                                                  Wide(motion.velocity) / gain_,
                                                  Wide(motion.acceleration) / gain_};
    filter_.set(state, Scalar{});
  }

  /// Advances to this tick; the reference is the one held since the last tick.
  void step(Scalar reference) { filter_.step(reference); }

  ModelMotion<Scalar> motion() const {
    const auto& x = filter_.state();
    return {to<Scalar>(x[0] * gain_), to<Scalar>(x[1] * gain_), to<Scalar>(x[2] * gain_)};
  }

  /// The position's third derivative from this tick on, under the reference held until the next.
  Scalar jerk(Scalar reference) const {
    return to<Scalar>(filter_.highest_derivative(reference) * gain_);
  }

 private:
  StateVariableFilter<Scalar, 3, Hold::zero_order> filter_;
  Accumulator<Scalar> gain_;
};

}  // namespace supercoil::control
