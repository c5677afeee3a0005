// Direct model reference adaptive control whose parameters are found by least squares.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>

#include "supercoil/control/estimation/ud_covariance.hpp"
#include "supercoil/control/tracking/fixed_pid.hpp"
#include "supercoil/control/tracking/mrac_matching.hpp"

namespace supercoil::control {

/// mrac-c of docs/compare.md. The constants were found by trials on the paper's muscle at 10 µm
/// of noise; signals are in watts at rest.
struct MracLeastSquaresSettings {
  /// θ1 (on s·u/λ, u/λ), θ2 (on s·y/λ, y/λ), θ3 (on y), c0 (on r), a power bias.
  using Parameters = Vector<double, 7>;

  RegressionScale scale;               ///< of the nominal muscle
  double filter_rad_per_s = 10.0;      ///< λ = (s + this)²
  double regression_rad_per_s = 12.0;  ///< F = 1/(s/this + 1)²
  double forgetting_s = 30.0;          ///< in which an observation's weight falls to 1/e
  double noise_W2 = 1e-4;              ///< R; only its ratio to the prior matters
  double prior_variance = 1.0;         ///< of each θ over its scale; no variance grows beyond
  /// The muscle has changed when the residual's mean square over 0.2 s exceeds the square of this.
  double change_W = 1e-3;
  double boost = 0.1;     ///< then added to each variance
  double hold_s = 6.0;    ///< after a change, the law uses the previous estimate
  double follow_s = 1.0;  ///< time constant with which the law follows the estimate
  /// ωc of the additional fixed PID: Kp = ωc θ3, Kd = ωc θ2, Ki = ωc θ4 of the nominal muscle.
  double bandwidth_rad_per_s = 2.0;
  double derivative_filter_rad_per_s = 60.0;  ///< of the error, twice this pole
};

/// This law's λ and α, as MracSettings.
MracSettings filters_of(const MracLeastSquaresSettings& settings);

/// θ* of the nominal muscle; any valid one has a θ*. Its compensator may be unstable: see the docs.
std::optional<MracMatching> match(const MracLeastSquaresSettings& settings,
                                  const ReferenceModelSettings& model);

/// The plant is a muscle with the model's relative degree, so a θ* makes the loop equal its model:
///   u = θ*ᵀω + c0* r + d,  ω = [α/λ·u, α/λ·y, y],
/// and then r = Wm⁻¹y for any u. Filtered by Wm and F this is a regression in available signals,
///   Wm F u = θ*ᵀ Wm F ω + c0* F y + d*,
/// which holds in closed loop, limited or not, whatever is added to u.
template <class Scalar>
class MracLeastSquares {
  static_assert(std::is_floating_point_v<Scalar>, "a covariance spans more than fixed point does");

 public:
  using Wide = Accumulator<Scalar>;
  static constexpr int size = 7;
  using Parameters = Vector<Scalar, size>;

  /// model: the reference model in use.
  /// step_s: the sampling period in seconds, > 0.
  MracLeastSquares(const MracLeastSquaresSettings& s, const ReferenceModelSettings& model,
                   double step_s)
      : settings_(s),
        ticks_per_update_(std::max<std::int64_t>(1, std::llround(update_s / step_s))),
        period_s_(step_s * static_cast<double>(ticks_per_update_)),
        power_(squared_pole(s.filter_rad_per_s), step_s),
        position_(squared_pole(s.filter_rad_per_s), step_s),
        far_power_(all_poles(s, model), step_s),
        far_position_(all_poles(s, model), step_s),
        pid_(s.scale, s.bandwidth_rad_per_s, s.derivative_filter_rad_per_s, step_s),
        scale_(scale_of(s, model)),
        follow_step_(step_s / s.follow_s),
        forgetting_(to<Scalar>(std::exp(-period_s_ / s.forgetting_s))),
        error_smoothing_(to<Scalar>(-std::expm1(-period_s_ / mean_square_s))),
        covariance_(Parameters::Constant(to<Scalar>(s.prior_variance))) {
    const Polynomial<2> lambda = squared_pole(s.filter_rad_per_s);
    const Polynomial<5> inner = multiply<2, 3>(lambda, model.denominator);
    const double gain = s.regression_rad_per_s * s.regression_rad_per_s;
    for (int i = 0; i < 3; ++i)
      lambda_[i] = Wide(lambda[static_cast<std::size_t>(i)]);
    for (int i = 0; i < 6; ++i)
      inner_[i] = Wide(inner[static_cast<std::size_t>(i)] * gain);
    model_gain_ = Wide(model.gain * gain);
    theta_ = WideParameters::Zero();
    theta_[reference_at] = Wide(first_c0) / scale_[reference_at];
    follower_ = theta_;
  }

  /// The muscle was identified: tunes the PID to it. Not while the law runs.
  void retune(const Theta& theta) { pid_.retune(theta); }

  /// Settles the filters as if the muscle had long moved as it does. To hold a power, the integral
  /// becomes that power less the rest.
  void start(const LawStart<Scalar>& at) {
    const Scalar rate = at.model.velocity;
    power_.settle(at.power, rate);
    position_.settle(at.position, rate);
    far_power_.settle(at.power, rate);
    far_position_.settle(at.position, rate);
    pid_.start(at);
    if (!at.hold) return;
    LawInput<Scalar> now;
    now.reference = at.reference;
    now.position = at.position;
    now.model = at.model;
    pid_.hold(now, at.power, certain(now));
  }

  /// Returns the demanded power.
  Scalar step(const LawInput<Scalar>& in) {
    power_.step(in.applied);
    position_.step(in.position);
    far_power_.step(in.applied);
    far_position_.step(in.position);
    pid_.update_derivative(in);
    if (++tick_ == ticks_per_update_) update();
    if (since_change_s() > settings_.hold_s)
      follower_ += (clamped_parameters() - follower_) * follow_step_;
    return pid_.step(in, certain(in));
  }

  static constexpr std::size_t gains = size + FixedPid<Scalar>::gains;
  GainValue gain(std::size_t i) const {
    constexpr auto first = static_cast<std::size_t>(Gain::power_rate);
    if (i < bias_at) return {static_cast<Gain>(first + i), theta()[static_cast<Eigen::Index>(i)]};
    if (i == bias_at) return {Gain::bias, theta()[bias_at]};
    return pid_.gain(i - size);
  }

  /// The parameters that the law uses.
  Vector<double, size> theta() const {
    return follower_.cwiseProduct(scale_).template cast<double>();
  }
  std::int64_t changes() const { return changes_; }

 private:
  using WideParameters = Vector<Wide, size>;

  static constexpr int reference_at = 5;
  static constexpr int bias_at = 6;
  static constexpr double update_s = 0.01;
  static constexpr double mean_square_s = 0.2;  ///< over which a change shows
  static constexpr double blind_s = 10.0;       ///< early errors are from the start, not a change
  static constexpr double change_every_s = 5.0;
  static constexpr double first_c0 = 0.2;  ///< a fifth of what the nominal muscle at rest needs
  static constexpr double min_c0 = 0.3;    ///< of the nominal one; the smallest that the law uses
  static constexpr double max_c0 = 3.0;
  static constexpr double min_scale = 0.05;  ///< a θ* near 0 is not known to be 0

  /// |θ*| of the nominal muscle.
  static WideParameters scale_of(const MracLeastSquaresSettings& s,
                                 const ReferenceModelSettings& model) {
    WideParameters scale = WideParameters::Ones();
    if (const auto matched = match(s, model)) {
      scale.template head<6>() =
          matched->theta.cwiseAbs().cwiseMax(min_scale).template cast<Wide>();
    }
    return scale;
  }
  /// λ, Wm's denominator, and F's.
  static Polynomial<7> all_poles(const MracLeastSquaresSettings& s,
                                 const ReferenceModelSettings& model) {
    return multiply<5, 2>(multiply<2, 3>(squared_pole(s.filter_rad_per_s), model.denominator),
                          squared_pole(s.regression_rad_per_s));
  }

  double since_change_s() const {
    return changes_ == 0 ? INFINITY : static_cast<double>(since_change_) * period_s_;
  }

  /// Regresses Wm F u on [Wm F ω, F y, 1], in the units of the scale.
  void update() {
    tick_ = 0;
    ++updates_;
    const auto& u = far_power_.state();
    const auto& y = far_position_.state();
    const Wide target = lambda_.dot(u.template head<3>()) * model_gain_;
    WideParameters phi;
    phi << lambda_[1] * u[1] * model_gain_, lambda_[0] * u[0] * model_gain_,
        lambda_[1] * y[1] * model_gain_, lambda_[0] * y[0] * model_gain_,
        lambda_.dot(y.template head<3>()) * model_gain_, inner_.dot(y.template head<6>()), Wide(1);
    phi = phi.cwiseProduct(scale_).eval();

    const auto error = to<Scalar>(target - theta_.dot(phi));
    const Parameters gain = covariance_.update(phi.template cast<Scalar>(),
                                               to<Scalar>(settings_.noise_W2), forgetting_, 0);
    theta_ += gain.template cast<Wide>() * Wide(error);
    cap();
    detect_change(error);
  }

  /// Without excitation, forgetting alone would let the covariance grow without bound.
  void cap() {
    const Scalar max_variance = covariance_.max_variance(0);
    const auto limit = to<Scalar>(settings_.prior_variance);
    if (max_variance > limit) covariance_.scale(limit / max_variance);
  }

  void detect_change(Scalar error) {
    error_square_ += (error * error - error_square_) * error_smoothing_;
    ++since_change_;
    const bool blind =
        static_cast<double>(updates_) * period_s_ < blind_s || since_change_s() < change_every_s;
    if (blind || error_square_ < to<Scalar>(settings_.change_W * settings_.change_W)) return;
    ++changes_;
    since_change_ = 0;
    error_square_ = Scalar{};
    covariance_.inflate(to<Scalar>(settings_.boost));
  }

  /// The estimate, with c0 within its bounds.
  WideParameters clamped_parameters() const {
    WideParameters clamped_parameters = theta_;
    clamped_parameters[reference_at] =
        std::clamp(clamped_parameters[reference_at], Wide(min_c0), Wide(max_c0));
    return clamped_parameters;
  }

  Scalar certain(const LawInput<Scalar>& in) const {
    const auto& u = power_.state();
    const auto& y = position_.state();
    WideParameters omega;
    omega << u[1] * lambda_[1], u[0] * lambda_[0], y[1] * lambda_[1], y[0] * lambda_[0],
        Wide(in.position), Wide(in.reference), Wide(1);
    return to<Scalar>(follower_.cwiseProduct(scale_).dot(omega));
  }

  MracLeastSquaresSettings settings_;
  std::int64_t ticks_per_update_;
  double period_s_;
  StateVariableFilter<Scalar, 2, Hold::zero_order> power_;
  StateVariableFilter<Scalar, 2, Hold::first_order> position_;
  StateVariableFilter<Scalar, 7, Hold::zero_order> far_power_;
  StateVariableFilter<Scalar, 7, Hold::first_order> far_position_;
  FixedPid<Scalar> pid_;
  WideParameters scale_;
  Wide follow_step_;
  Scalar forgetting_;
  Scalar error_smoothing_;
  UdCovariance<Scalar, size> covariance_;
  Vector<Wide, 3> lambda_;
  Vector<Wide, 6> inner_;  ///< λ and Wm's denominator, times F's gain
  Wide model_gain_{};      ///< Wm's and F's

  WideParameters theta_;     ///< over scale_
  WideParameters follower_;  ///< θ̄ over scale_
  std::int64_t tick_ = 0;
  std::int64_t updates_ = 0;
  std::int64_t since_change_ = 0;
  std::int64_t changes_ = 0;
  Scalar error_square_{};
};

/// `mrac_ls`: how MracLeastSquares is named, set, made and checked (LawDefinition).
struct MracLeastSquaresLaw : LawDefaults {
  using Settings = MracLeastSquaresSettings;
  template <class Scalar>
  using In = MracLeastSquares<Scalar>;
  static constexpr std::string_view name = "mrac_ls";
  static constexpr bool fixed_point = false;
  static constexpr bool adapts = true;
  static constexpr std::string_view when_unstable = "lower its bandwidth_rad_per_s";
  static constexpr std::array values{
      setting_value<Settings, &Settings::bandwidth_rad_per_s>("bandwidth_rad_per_s"),
      setting_value<Settings, &Settings::derivative_filter_rad_per_s>(
          "derivative_filter_rad_per_s"),
      setting_value<Settings, &Settings::follow_s>("follow_s"),
      setting_value<Settings, &Settings::forgetting_s>("forgetting_s"),
      setting_value<Settings, &Settings::filter_rad_per_s>("filter_rad_per_s"),
      setting_value<Settings, &Settings::regression_rad_per_s>("regression_rad_per_s"),
      setting_value<Settings, &Settings::change_W>("change_W"),
      setting_value<Settings, &Settings::hold_s>("hold_s")};

  template <class Scalar>
  static MracLeastSquares<Scalar> make(const Settings& s, const LawContext& context,
                                       double step_s) {
    return {s, context.model, step_s};
  }
  static std::optional<FixedLaw> fixed_law(const Settings& s, const LawContext& context,
                                           const PhysicalParameters& muscle);
  static void set_nominal(Settings& s, const RegressionScale& scale, double max_W);
};

}  // namespace supercoil::control
