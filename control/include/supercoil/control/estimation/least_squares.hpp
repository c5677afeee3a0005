// Recursive least squares with forgetting, for muscles that change.
#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "supercoil/control/estimation/estimate_accuracy.hpp"
#include "supercoil/control/estimation/filtered_regression.hpp"
#include "supercoil/control/estimation/projection.hpp"
#include "supercoil/control/estimation/ud_covariance.hpp"

namespace supercoil::control {

/// The constants were found by trials on the paper's muscle at 10 µm of noise (docs/decisions.md).
struct LeastSquaresSettings {
  RegressionScale scale;
  Theta initial = scale.nominal;  ///< θ(0)
  double forgetting_s = 30.0;     ///< time in which an observation's weight falls to 1/e
  double noise_W2 = 1e-7;         ///< R, of the residual; what counts is how it stands to the prior
  double prior_variance = 100.0;  ///< of each θ over its nominal: C(0), and the most that C becomes
  double lowest_part = 0.2;       ///< θ is kept between these parts of its nominal
  double highest_part = 5.0;
  double largest_bias_W = 3.0;
  /// The muscle has changed when the residual's mean square over 0.2 s exceeds this one's square.
  double change_W = 0.004;
  double position_noise_m = 10e-6;  ///< expected, rms; see EstimateAccuracy
};

template <class Scalar>
class LeastSquaresEstimator {
  static_assert(std::is_floating_point_v<Scalar>, "a covariance spans more than fixed point does");

 public:
  using ScalarType = Scalar;
  using Wide = Accumulator<Scalar>;
  using Regression = FilteredRegression<Scalar>;
  /// θ over nominal, then the bias in W.
  using Parameters = Vector<double, 5>;

  /// step_s: the sampling period in seconds, > 0.
  LeastSquaresEstimator(const LeastSquaresSettings& s, double step_s)
      : LeastSquaresEstimator(s, step_s,
                              std::max<std::int64_t>(1, std::llround(update_s / step_s))) {}

  /// One tick. position_W: position over the DC gain. applied_power_W: the power really applied
  /// since the last tick.
  void step(Scalar position_W, Scalar applied_power_W) {
    if (begins_) {
      begins_ = false;
      updates_ = 0;
      start_filters(position_W, abs(position_W));
    }
    regression_.step(position_W, applied_power_W);
    if (++tick_ == ticks_per_update_) update(position_W);
  }

  /// The muscle is heated anew after a pause: the filters start at rest, what was learned stays.
  void restart() { begins_ = true; }

  /// The nearest point of the bounds. Only what is told is projected: a θ moved under the recursion
  /// would no longer be what its covariance says (after changes it then did not converge at all).
  Parameters parameters() const {
    return project<double, 5>(theta_.template tail<5>().template cast<double>(), bounds_);
  }
  const Parameters& standard_deviations() const { return deviations_; }
  /// ε = z − θᵀφ of the last update, in watts through 1/Λ'.
  double error() const { return static_cast<double>(error_); }
  /// Since it began or began anew, and since the last detected change (infinity before any).
  double running_s() const { return static_cast<double>(updates_) * period_s_; }
  double since_change_s() const {
    return changes_ == 0 ? INFINITY : static_cast<double>(since_change_) * period_s_;
  }
  std::int64_t changes() const { return changes_; }
  /// θ predicts what the muscle does, in the direction of its motion at least.
  bool settled() const { return running_s() > settled_s && since_change_s() > resettled_s; }

 private:
  static constexpr int size = Regression::size;
  static constexpr int free = Regression::free;
  using All = Vector<Scalar, size>;

  static constexpr double update_s = 0.01;
  static constexpr double mean_square_s = 0.2;  ///< over which a change shows
  static constexpr double blind_s = 10.0;       ///< at first errors are the start's, not a change's
  static constexpr double change_every_s = 5.0;
  /// Trials (adaptive feedforward): after a change θ overshoots for some seconds, from rest it does
  /// not.
  static constexpr double settled_s = 3.0;
  static constexpr double resettled_s = 6.0;
  /// Λ's slowest poles decay with 0.755/s: by then 3·10⁻⁷ is left of a free response.
  static constexpr double free_s = 20.0;
  /// Wide enough for any motion: ten times the power of the paper's muscle.
  static constexpr double change_span_W = 10.0;
  static constexpr std::int64_t updates_per_accuracy = 10;

  LeastSquaresEstimator(const LeastSquaresSettings& s, double step_s, std::int64_t ticks_per_update)
      : settings_(s),
        ticks_per_update_(ticks_per_update),
        period_s_(step_s * static_cast<double>(ticks_per_update)),
        regression_(s.scale, step_s, period_s_),
        accuracy_({.scale = s.scale,
                   .update_s = period_s_,
                   .averaging_s = s.forgetting_s,
                   .noise_m2_per_Hz = s.position_noise_m * s.position_noise_m * step_s,
                   .counted_W2 = s.noise_W2}),
        forgetting_(to<Scalar>(std::exp(-period_s_ / s.forgetting_s))),
        change_share_(to<Scalar>(-std::expm1(-period_s_ / mean_square_s))),
        covariance_(All::Zero()) {
    theta_ << Vector<Wide, free>::Zero(), s.initial.cwiseQuotient(s.scale.nominal), Wide{};
    bounds_.lower << Vector<double, 4>::Constant(s.lowest_part), -s.largest_bias_W;
    bounds_.upper << Vector<double, 4>::Constant(s.highest_part), s.largest_bias_W;
    forget();
  }

  /// Filters start at rest. What the muscle's motion leaves in them is estimated along; span_W, how
  /// far from rest it may be (position over the DC gain), gives the prior.
  void start_filters(Scalar position_W, Scalar span_W) {
    regression_.restart(position_W);
    accuracy_.restart_filters();
    tick_ = 0;
    since_start_ = 0;
    first_ = 0;
    theta_.template head<free>().setZero();
    const RegressionScale& scale = settings_.scale;
    const double span_m = static_cast<double>(span_W) * scale.dc_gain_m_per_W;
    const Vector<double, free> coefficients =
        Vector<double, free>{scale.nominal[0] * scale.moving_mass_kg, scale.nominal[1],
                             scale.nominal[2]} *
        span_m;
    const Vector<double, free> variances = coefficients.cwiseProduct(coefficients);
    covariance_.template renew_first<free>(variances.template cast<Scalar>());
    accuracy_.forget_first(variances);
  }

  void end_free_responses() {
    first_ = free;
    theta_.template head<free>().setZero();
    const Vector<double, free> known = Vector<double, free>::Zero();
    covariance_.template renew_first<free>(known.template cast<Scalar>());
    accuracy_.forget_first(known);
  }

  /// Nothing is known of θ, whatever it is now.
  void forget() {
    const Vector<double, size> variances = Vector<double, size>::Constant(settings_.prior_variance);
    covariance_.reset(variances.template cast<Scalar>());
    accuracy_.forget(variances);
  }

  void update(Scalar position_W) {
    tick_ = 0;
    ++updates_;
    ++since_start_;
    regression_.update();
    const All& phi = regression_.phi();
    error_ = regression_.z() - theta_.template cast<Scalar>().dot(phi);
    const All gain = covariance_.update(phi, to<Scalar>(settings_.noise_W2), forgetting_, first_);
    theta_ += gain.template cast<Wide>() * Wide(error_);
    const double growth = cap() / static_cast<double>(forgetting_);

    accuracy_.step(seen(growth));
    if (updates_ % updates_per_accuracy == 0) {
      deviations_ = accuracy_.standard_deviations(covariance_.matrix().template cast<double>(),
                                                  theta_.template cast<double>());
    }
    if (first_ == 0 && static_cast<double>(since_start_) * period_s_ > free_s) end_free_responses();
    detect_change(position_W);
  }

  /// Without excitation forgetting alone would let the covariance grow for ever. All of it is
  /// scaled, which keeps its factors: what is well known is then not forgotten either.
  double cap() {
    const Scalar largest = covariance_.largest_variance(free);
    const auto most = to<Scalar>(settings_.prior_variance);
    if (!(largest > most)) return 1.0;
    covariance_.scale(most / largest);
    return static_cast<double>(most / largest);
  }

  EstimateAccuracy::Seen seen(double growth) const {
    const All& phi = regression_.phi();
    const All theta = theta_.template cast<Scalar>();
    const Scalar motion = theta.template segment<4>(free).dot(phi.template segment<4>(free));
    return {theta_.template cast<double>(),
            static_cast<double>(motion),
            regression_.of_impulse(),
            regression_.of_one(),
            static_cast<double>(regression_.z() - theta.dot(phi)),
            growth};
  }

  void detect_change(Scalar position_W) {
    error_square_ += (error_ * error_ - error_square_) * change_share_;
    ++since_change_;
    const bool blind = running_s() < blind_s || since_change_s() < change_every_s;
    if (blind || error_square_ < to<Scalar>(settings_.change_W * settings_.change_W)) return;
    ++changes_;
    since_change_ = 0;
    error_square_ = Scalar{};
    forget();
    start_filters(position_W, to<Scalar>(change_span_W));
  }

  LeastSquaresSettings settings_;
  std::int64_t ticks_per_update_;
  double period_s_;
  Regression regression_;
  EstimateAccuracy accuracy_;
  Scalar forgetting_;
  Scalar change_share_;
  UdCovariance<Scalar, size> covariance_;
  Vector<Wide, size> theta_;
  Box<double, 5> bounds_;
  Parameters deviations_ = Parameters::Constant(INFINITY);

  bool begins_ = true;
  int first_ = 0;  ///< of the parameters that are estimated: 0 with, 3 without the free responses
  std::int64_t tick_ = 0;
  std::int64_t updates_ = 0;
  std::int64_t since_start_ = 0;  ///< of the filters, in updates
  std::int64_t since_change_ = 0;
  std::int64_t changes_ = 0;
  Scalar error_{};
  Scalar error_square_{};  ///< low-passed
};

}  // namespace supercoil::control
