// Direct model reference adaptive control of relative degree three.
#pragma once

#include <array>

#include "supercoil/control/tracking/law_definition.hpp"
#include "supercoil/control/tracking/mrac_settings.hpp"

namespace supercoil::control {

/// Eqs. (9)–(17) of the paper with the corrections of docs/paper.md:
///   ω = [α/λ·u, α/λ·y, y, r],  φ1 = ω/(s + p1),  φ = φ1/(s + p0),  q = φᵀΠφ
///   θ̇ = −Π ε1 φ,  σ̇ = ν ε1 r0,  ṙ0 = −p0 r0 − α0 r0 q² + q ε1
///   ê1 = σ r0/(s + q0),  ε1 = (y − ym) − ê1
///   u = θᵀω + θ̇ᵀφ1 − α0(p1 − p0)q² r0 − 4α0 q (φᵀΠφ̇) r0 + α0² q⁴ r0 − α0 q³ ε1
/// u drives the filters after clipping. Signals and parameters are of type Scalar; states, and what
/// takes high powers of q, are of its accumulator type.
template <class Scalar>
class Mrac {
 public:
  using Wide = Accumulator<Scalar>;
  using Parameters = Vector<Scalar, 6>;
  using WideParameters = Vector<Wide, 6>;

  /// step_s: the sampling period in seconds, > 0. Check the premises first (mrac_premises.hpp).
  Mrac(const MracSettings& settings, double step_s)
      : power_filter_(settings.lambda, step_s),
        position_filter_(settings.lambda, step_s),
        first_bank_(settings.p1_rad_per_s, step_s, inputs_held),
        second_bank_(settings.p0_rad_per_s, step_s, none_held),
        first_gain_(1.0 / settings.p1_rad_per_s),
        inverse_lambda_(1.0 / settings.lambda[0]),
        alpha_{Wide(settings.alpha[0]), Wide(settings.alpha[1])},
        step_(step_s),
        rate_(1.0 / step_s),
        p0_(settings.p0_rad_per_s),
        p1_minus_p0_(settings.p1_rad_per_s - settings.p0_rad_per_s),
        q0_(settings.q0_rad_per_s),
        gain_step_((settings.scaled_gain() * step_s).template cast<Scalar>()),
        sigma_gain_(settings.scaled_sigma_gain()),
        damping_(settings.damping),
        leaks_(settings.sigma_modification > 0.0),
        leak_step_((settings.scaled_gain() * (settings.sigma_modification * step_s))
                       .template cast<Wide>()),
        dead_zone_(settings.dead_zone_W),
        freeze_when_limited_(settings.freeze_when_limited),
        initial_(settings.initial.template cast<Wide>()),
        initial_sigma_(settings.initial_sigma),
        theta_(initial_),
        sigma_(initial_sigma_) {
    if (settings.bounds) {
      bounds_ = Box<Wide, 6>{settings.bounds->lower.template cast<Wide>(),
                             settings.bounds->upper.template cast<Wide>()};
    }
  }

  /// Settles the filters as if the muscle had long moved as it does. To hold a power, c0 is set so
  /// that θᵀω is that power: a pure feedforward. (The smallest change of the whole θ would add
  /// positive feedback, and ring for half a minute.)
  void start(const LawStart<Scalar>& at) {
    // Power, position and reference are in watts at rest: in steady motion they move alike.
    const Scalar rate = at.model.velocity;
    power_filter_.settle(at.power, rate);
    position_filter_.settle(at.position, rate);
    const WideParameters omega = regressors(at.position, at.reference);
    omega_ = omega.template cast<Scalar>();
    const Wide filtered = Wide(rate) * alpha_[1] * inverse_lambda_;
    WideParameters rates;
    rates << Wide{}, filtered, Wide{}, filtered, Wide(rate), Wide(rate);
    first_bank_.settle(omega, rates);
    second_bank_.settle(first_bank_.state(), rates * first_gain_);
    theta_ = initial_;
    sigma_ = initial_sigma_;
    r0_ = estimated_error_ = Wide{};
    if (at.hold && at.reference > to<Scalar>(0.05)) {
      const Wide c0 = theta_[5] + (Wide(at.power) - theta_.dot(omega)) / Wide(at.reference);
      if (c0 > Wide(0) && c0 < Wide(3)) theta_[5] = c0;
    }
  }

  /// Returns the demanded power.
  Scalar step(const LawInput<Scalar>& in) {
    filter(in);
    const Wide epsilon = Wide(in.position - in.model.position) - estimated_error_;
    const bool rests = (freeze_when_limited_ && in.limited) || abs(epsilon) < dead_zone_;

    const WideParameters& phi1 = first_bank_.state();
    const Parameters phi = second_bank_.state().template cast<Scalar>();
    const Parameters direction = gain_step_.cwiseProduct(phi);  // Π φ·step
    const Parameters slope = (phi1 - second_bank_.state() * p0_).template cast<Scalar>();  // φ̇
    WideParameters change = WideParameters::Zero();  // θ̇·step
    if (!rests) {
      change = -(direction.template cast<Wide>() * epsilon);
      if (leaks_) change -= (theta_ - initial_).cwiseProduct(leak_step_);
    }

    const Wide q = Wide(phi.dot(direction)) * rate_;
    const Wide q_slope = Wide(slope.dot(direction)) * rate_;
    const Scalar certain = theta_.template cast<Scalar>().dot(omega_);
    const Wide demanded = Wide(certain) + change.dot(phi1) * rate_ + damping(q, q_slope, epsilon);

    adapt(change, q, epsilon, rests);
    return to<Scalar>(demanded);
  }

  static constexpr std::size_t gains = 7;
  GainValue gain(std::size_t i) const {
    constexpr auto first = static_cast<std::size_t>(Gain::power_rate);
    if (i + 1 == gains) return {Gain::sigma, sigma()};
    return {static_cast<Gain>(first + i),
            static_cast<double>(theta_[static_cast<Eigen::Index>(i)])};
  }

  const WideParameters& theta() const { return theta_; }
  double sigma() const { return static_cast<double>(sigma_); }
  /// The filtered signals that θ multiplies, and Eq. (16)'s r0 = u/((s+p0)(s+p1)) − θᵀφ.
  const WideParameters& phi() const { return second_bank_.state(); }
  double r0() const { return static_cast<double>(r0_); }
  /// ê1; ε1 = (y − ym) − ê1.
  double estimated_error() const { return static_cast<double>(estimated_error_); }

 private:
  static constexpr std::array<bool, 6> inputs_held{false, false, false, false, false, true};
  static constexpr std::array<bool, 6> none_held{};

  void filter(const LawInput<Scalar>& in) {
    power_filter_.step(in.applied);
    position_filter_.step(in.position);
    const WideParameters omega = regressors(in.position, in.reference);
    omega_ = omega.template cast<Scalar>();
    first_bank_.step(omega);
    second_bank_.step(first_bank_.state());
  }

  /// ω from the filters' states.
  WideParameters regressors(Scalar position, Scalar reference) const {
    const auto& u = power_filter_.state();
    const auto& y = position_filter_.state();
    WideParameters omega;
    omega << u[1] * alpha_[0], u[0] * alpha_[1], y[1] * alpha_[0], y[0] * alpha_[1], Wide(position),
        Wide(reference);
    return omega;
  }

  /// The terms of Eq. (17) with α0.
  Wide damping(Wide q, Wide q_slope, Wide epsilon) const {
    const Wide q2 = q * q;
    const Wide on_r0 = damping_ * q2 * (damping_ * q2) - damping_ * p1_minus_p0_ * q2 -
                       Wide(4) * damping_ * q * q_slope;
    return on_r0 * r0_ - damping_ * q2 * q * epsilon;
  }

  void adapt(const WideParameters& change, Wide q, Wide epsilon, bool rests) {
    theta_ += change;
    if (bounds_) theta_ = project(theta_, *bounds_);
    if (!rests) sigma_ += sigma_gain_ * epsilon * r0_ * step_;
    // Semi-implicit: r0's decay α0 q² reaches thousands per second at large gains.
    r0_ = (r0_ + q * epsilon * step_) / (Wide(1) + (p0_ + damping_ * q * q) * step_);
    estimated_error_ = (estimated_error_ + sigma_ * r0_ * step_) / (Wide(1) + q0_ * step_);
  }

  StateVariableFilter<Scalar, 2, Hold::zero_order> power_filter_;
  StateVariableFilter<Scalar, 2, Hold::first_order> position_filter_;
  OnePoleBank<Scalar, 6> first_bank_;
  OnePoleBank<Scalar, 6> second_bank_;
  Wide first_gain_;
  Wide inverse_lambda_;
  std::array<Wide, 2> alpha_;
  Wide step_;
  Wide rate_;
  Wide p0_;
  Wide p1_minus_p0_;
  Wide q0_;
  Parameters gain_step_;  // Π·step: Π itself exceeds Q8.24
  Wide sigma_gain_;
  Wide damping_;
  bool leaks_;
  WideParameters leak_step_;
  Wide dead_zone_;
  bool freeze_when_limited_;
  WideParameters initial_;
  Wide initial_sigma_;
  std::optional<Box<Wide, 6>> bounds_;

  Parameters omega_ = Parameters::Zero();
  WideParameters theta_;
  Wide sigma_;
  Wide r0_{};
  Wide estimated_error_{};
};

/// `mrac`: how Mrac is named, set, made and checked (LawDefinition).
struct MracLaw : LawDefaults {
  using Settings = MracSettings;
  template <class Scalar>
  using In = Mrac<Scalar>;
  static constexpr std::string_view name = "mrac";
  static constexpr bool adapts = true;
  static constexpr std::string_view when_unstable =
      "use slower filters or a slower reference model";
  static constexpr std::array values{
      setting_value<Settings, &Settings::adaptation_scale>("adaptation_scale"),
      element_value<Settings, &Settings::gain, 0>("gain_1"),
      element_value<Settings, &Settings::gain, 1>("gain_2"),
      element_value<Settings, &Settings::gain, 2>("gain_3"),
      element_value<Settings, &Settings::gain, 3>("gain_4"),
      element_value<Settings, &Settings::gain, 4>("gain_5"),
      element_value<Settings, &Settings::gain, 5>("gain_6"),
      setting_value<Settings, &Settings::sigma_gain>("sigma_gain"),
      setting_value<Settings, &Settings::damping>("damping"),
      element_value<Settings, &Settings::alpha, 0>("alpha_1"),
      element_value<Settings, &Settings::alpha, 1>("alpha_2"),
      element_value<Settings, &Settings::lambda, 1>("lambda_1"),
      element_value<Settings, &Settings::lambda, 0>("lambda_2"),
      setting_value<Settings, &Settings::p0_rad_per_s>("p0_rad_per_s"),
      setting_value<Settings, &Settings::p1_rad_per_s>("p1_rad_per_s"),
      setting_value<Settings, &Settings::q0_rad_per_s>("q0_rad_per_s"),
      setting_value<Settings, &Settings::freeze_when_limited>("freeze_when_limited"),
      setting_value<Settings, &Settings::sigma_modification>("sigma_modification"),
      setting_value<Settings, &Settings::dead_zone_W>("dead_zone_W"),
  };

  template <class Scalar>
  static Mrac<Scalar> make(const Settings& s, const LawContext&, double step_s) {
    return {s, step_s};
  }
  static std::optional<FixedLaw> fixed_law(const Settings& s, const LawContext& context,
                                           const PhysicalParameters& muscle);
  /// Premises that fail (mrac_premises.hpp).
  static void add_contradictions(LawProblems& problems, const Settings& s,
                                 const LawContext& context);
  static void check_fit(FixedPointFit& fit, const Settings& s, const LawContext& context,
                        double step_s, double peak_W);
};

}  // namespace supercoil::control
