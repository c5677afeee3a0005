// Recursive least squares with forgetting, for muscles that change.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "supercoil/control/estimation/change_watch.hpp"
#include "supercoil/control/estimation/estimate_accuracy.hpp"
#include "supercoil/control/estimation/estimate_drift.hpp"
#include "supercoil/control/estimation/estimator_definition.hpp"
#include "supercoil/control/estimation/filtered_regression.hpp"
#include "supercoil/control/estimation/projection.hpp"
#include "supercoil/control/estimation/residual_watch.hpp"
#include "supercoil/control/estimation/simplest_change.hpp"
#include "supercoil/control/estimation/ud_covariance.hpp"

namespace supercoil::control {

/// The constants were found by trials on the paper's muscle at 10 µm of noise (docs/decisions.md).
struct LeastSquaresSettings {
  RegressionScale scale;
  Theta initial = scale.nominal;  ///< θ(0)
  double forgetting_s = 30.0;     ///< time in which an observation's weight falls to 1/e
  /// √R, the residual's assumed deviation, over max_W; only its ratio to the prior matters.
  double residual_ratio = 7e-5;
  double prior_variance = 100.0;  ///< C(0), of each θ over its nominal
  /// Of each θ over its nominal, from `initial`, when nothing excites it.
  double unexcited_deviation = 0.5;
  double min_ratio = 0.2;  ///< θ over its nominal is kept between these
  double max_ratio = 5.0;
  double max_bias_W = 3.0;
  double max_W = 4.5;               ///< > 0, the largest power: the scale of changes
  double position_noise_m = 10e-6;  ///< expected, rms; see EstimateAccuracy
  bool detects_changes = true;      ///< otherwise it only forgets; for comparison
};

/// A ChangeWatch tells changes from the model's own error. After a change θ may be anywhere along
/// the directions in which muscles change, and is otherwise known as before; the filters restart,
/// so that they hold no motion of the old muscle. Meanwhile the estimator reports the
/// SimplestChange that explains the data, and until there is one, θ from before.
///
/// Unexcited parameters return to `initial` while the others learn: otherwise model errors make
/// them drift to the bounds, and their covariance grows without bound. Real muscles leave residuals
/// far above R that last for seconds; everything added to the covariance is scaled by how far.
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
    updated_ = restart_pending_;
    if (restart_pending_) {
      restart_pending_ = false;
      updates_ = 0;
      start_filters(position_W, abs(position_W));
      watch_.restart(position_W);
    }
    regression_.step(position_W, applied_power_W);
    watch_.step(position_W, applied_power_W);
    if (++tick_ == ticks_per_update_) update(position_W);
  }

  /// The muscle is heated again after a pause: the filters start at rest, what was learned stays.
  void restart() { restart_pending_ = true; }

  /// True when the reported estimate may have changed in the last tick.
  bool updated() const { return updated_; }
  /// Within the bounds. Only the output is projected: a θ moved within the recursion would no
  /// longer match its covariance (after changes it then did not converge at all).
  const Parameters& parameters() const { return reported_; }
  const Parameters& standard_deviations() const { return deviations_; }
  /// The deviations are the roots of its diagonal; zero at first.
  const Matrix<double, 5>& covariance() const { return reported_covariance_; }
  /// ε = z − θᵀφ of the last update, in watts through 1/Λ'.
  double error() const { return static_cast<double>(error_); }
  /// Time since the start or restart, and since the last detected change (infinity before any).
  double running_s() const { return static_cast<double>(updates_) * period_s_; }
  double since_change_s() const {
    return changes_ == 0 ? INFINITY : static_cast<double>(since_change_) * period_s_;
  }
  std::int64_t changes() const { return changes_; }
  /// True when the deviations say how far θ is off: long enough after a start, a change, and any
  /// residual that they do not explain, and θ within its bounds.
  bool consistent() const {
    return settled() && residual_.usual_s() > resettled_s && bounds_.contains(estimated());
  }
  /// True when θ predicts the muscle, at least in the direction of its motion.
  bool settled() const {
    return running_s() > settled_s &&
           since_change_s() > (model_error_visible_ ? free_s : resettled_s);
  }

 private:
  static constexpr int size = Regression::size;
  static constexpr int free = Regression::free;
  using All = Vector<Scalar, size>;
  using Watch = ChangeWatch<Scalar>;

  static constexpr double update_s = 0.01;
  /// Trials (adaptive feedforward): after a change θ overshoots for some seconds, from rest it does
  /// not.
  static constexpr double settled_s = 3.0;
  static constexpr double resettled_s = 6.0;
  /// Λ's slowest poles decay with 0.755/s: by then 3·10⁻⁷ is left of a free response.
  static constexpr double free_s = 20.0;
  /// How far from rest the muscle may be when it changes, over max_W.
  static constexpr double change_span = 2.2;
  /// Standard deviations of a change: of a load over max_W, and of each θ over its nominal in
  /// addition to its move along the directions, which may be as large as θ.
  static constexpr double load_deviation = 0.25;
  static constexpr double other_deviation = 0.05;
  /// Deviation of the bias over max_W, when nothing excites it.
  static constexpr double unexcited_bias = 0.2;
  /// How long a model error lasts on the usual muscle.
  static constexpr double error_lasts_s = 0.5;
  static constexpr std::int64_t updates_per_accuracy = 10;
  /// Share of the drift's mean square in the covariance, and the drift's memory over its lag. Over
  /// random muscles (muscles_study) the best fit of the next minute is then within two deviations
  /// in 90 to 99 of 100 cases.
  static constexpr double drift_weight = 0.06;
  static constexpr double drift_memory = 30.0;

  LeastSquaresEstimator(const LeastSquaresSettings& s, double step_s, std::int64_t ticks_per_update)
      : settings_(s),
        ticks_per_update_(ticks_per_update),
        period_s_(step_s * static_cast<double>(ticks_per_update)),
        regression_(s.scale, step_s, period_s_),
        watch_(s.scale, s.max_W, step_s, period_s_),
        unexcited_(unexcited_variances(s)),
        accuracy_({.scale = s.scale,
                   .update_s = period_s_,
                   .averaging_s = s.forgetting_s,
                   .noise_m2_per_Hz = s.position_noise_m * s.position_noise_m * step_s,
                   .assumed_W2 = assumed_W2(),
                   .forgetting = std::exp(-period_s_ / s.forgetting_s),
                   .unexcited = unexcited_}),
        drift_(
            {.update_s = period_s_ * static_cast<double>(updates_per_accuracy),
             .lag_s = s.forgetting_s * std::max(1.0, slowness(s.scale.nominal)),
             .memory_s = drift_memory * s.forgetting_s * std::max(1.0, slowness(s.scale.nominal)),
             .unexcited = unexcited_}),
        residual_(period_s_),
        forgetting_(to<Scalar>(std::exp(-period_s_ / s.forgetting_s))),
        updates_per_error_(error_lasts_s * slowness(s.scale.nominal) / period_s_),
        explains_change_s_(free_s * std::max(1.0, slowness(s.scale.nominal))),
        covariance_(All::Zero()) {
    initial_ << s.initial.cwiseQuotient(s.scale.nominal), 0.0;
    theta_ << Vector<Wide, free>::Zero(), initial_.template cast<Wide>();
    bounds_.lower << Vector<double, 4>::Constant(s.min_ratio), -s.max_bias_W;
    bounds_.upper << Vector<double, 4>::Constant(s.max_ratio), s.max_bias_W;
    reported_ = project<double, 5>(initial_, bounds_);
    const Vector<double, size> variances = Vector<double, size>::Constant(s.prior_variance);
    covariance_.reset(variances.template cast<Scalar>());
    accuracy_.forget(variances);
  }

  double assumed_W2() const {
    const double rms_W = settings_.residual_ratio * settings_.max_W;
    return rms_W * rms_W;
  }

  static Parameters unexcited_variances(const LeastSquaresSettings& s) {
    Parameters deviations = Parameters::Constant(s.unexcited_deviation);
    deviations[4] = unexcited_bias * s.max_W;
    return deviations.cwiseAbs2();
  }

  /// Starts the filters at rest. What the muscle's motion leaves in them is estimated as well;
  /// span_W, how far from rest it may be (position over the DC gain), gives the prior.
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

  void update(Scalar position_W) {
    tick_ = 0;
    updated_ = true;
    ++updates_;
    ++since_start_;
    regression_.update();
    const All& phi = regression_.phi();
    error_ = regression_.z() - theta_.template cast<Scalar>().dot(phi);
    const All gain = covariance_.update(phi, to<Scalar>(assumed_W2()), forgetting_, first_);
    theta_ += gain.template cast<Wide>() * Wide(error_);
    const EstimateAccuracy::Observation seen = observation();
    accuracy_.step(seen);
    residual_.step(seen.residual_W, accuracy_.mean_square());
    scale_ = std::min(1.0, covariance_scale());
    if (running_s() > settled_s) return_unexcited();
    if (updates_ % updates_per_accuracy == 0) update_accuracy();
    if (first_ == 0 && static_cast<double>(since_start_) * period_s_ > free_s) end_free_responses();
    ++since_change_;
    const Parameters now = estimated();
    if (watch_.update(now) && settings_.detects_changes) change(position_W, now);
    publish_estimate();
  }

  Parameters estimated() const { return theta_.template tail<5>().template cast<double>(); }

  /// Learns from how θ has moved what the model's error adds.
  void update_accuracy() {
    const Vector<double, size> theta = theta_.template cast<double>();
    const auto parts = accuracy_.parts(covariance_.template matrix<double>(), theta);
    drift_.step(theta.template tail<5>(), parts.noise + parts.prior);
    model_error_visible_ = accuracy_.model_error_visible(theta);
    const double more =
        model_error_visible_ ? std::max(1.0, drift_weight * drift_.mean_square()) : 1.0;
    reported_covariance_ = more * parts.noise + parts.prior;
    if (more > 1.0 || explains_change())
      reported_covariance_ = accuracy_.bounded(reported_covariance_);
    deviations_ = reported_covariance_.diagonal().cwiseMax(0.0).cwiseSqrt();
  }

  /// True while the change may still be explained.
  bool explains_change() const { return since_change_s() < explains_change_s_; }

  void publish_estimate() {
    reported_ = estimated();
    if (explains_change()) {
      const auto simplest = change_.explained(reported_, assumed_covariance() / change_scale_);
      if (simplest) reported_ = *simplest;
      if (!simplest && !settled()) reported_ = change_.before();
    }
    if (!bounds_.contains(reported_))
      reported_ = project<5>(reported_, bounds_, assumed_covariance());
  }

  /// Acts as if one parameter after the other were observed at its initial value, with just the
  /// weight that leaves it the deviation of an unexcited one.
  void return_unexcited() {
    selector_ = (selector_ + 1) % 5;
    const double variance = unexcited_[selector_] * scale_;
    const double seen_variance =
        variance / (-std::expm1(-period_s_ / settings_.forgetting_s) * 5.0);
    const All gain = covariance_.update(All::Unit(free + selector_), to<Scalar>(seen_variance),
                                        Scalar(1), first_);
    const Wide off = Wide(initial_[selector_]) - theta_[free + selector_];
    theta_ += gain.template cast<Wide>() * off;
  }

  /// The covariance of θ1 … θ4 and the bias.
  Matrix<double, 5> assumed_covariance() const {
    return covariance_.template matrix<double>().template bottomRightCorner<5, 5>();
  }

  /// Assumed covariance over the true one, according to the residuals.
  double covariance_scale() const {
    return assumed_W2() / (accuracy_.mean_square() * updates_per_error_);
  }

  void change(Scalar position_W, const Parameters& theta) {
    ++changes_;
    since_change_ = 0;
    start_filters(position_W, to<Scalar>(change_span * settings_.max_W));
    typename Watch::Directions along = Watch::along(theta);
    along.col(Watch::load) *= load_deviation * settings_.max_W;
    Matrix<double, 5> more = along * along.transpose();
    more.diagonal().array() += other_deviation * other_deviation;

    const Matrix<double, 5> before = assumed_covariance();
    Matrix<Scalar, size> added = Matrix<Scalar, size>::Zero();
    change_scale_ = covariance_scale();
    change_.begin(theta, before / change_scale_, along, more);
    added.template bottomRightCorner<5, 5>() = (more * change_scale_).template cast<Scalar>();
    covariance_.add(added);
    drift_.forget_past();
    accuracy_.spread(before, assumed_covariance(), more);
  }

  EstimateAccuracy::Observation observation() const {
    const All& phi = regression_.phi();
    const All theta = theta_.template cast<Scalar>();
    const Scalar motion = theta.template segment<4>(free).dot(phi.template segment<4>(free));
    return {theta_.template cast<double>(),
            static_cast<double>(motion),
            regression_.impulse_response(),
            regression_.step_response(),
            static_cast<double>(regression_.z() - theta.dot(phi)),
            scale_};
  }

  LeastSquaresSettings settings_;
  std::int64_t ticks_per_update_;
  double period_s_;
  Regression regression_;
  Watch watch_;
  Parameters unexcited_;  ///< variances of what nothing excites
  EstimateAccuracy accuracy_;
  EstimateDrift drift_;
  ResidualWatch residual_;
  Scalar forgetting_;
  double updates_per_error_;  ///< a model error counts once per this many
  double explains_change_s_;  ///< for this time after a change
  SimplestChange change_;
  double change_scale_ = 1.0;  ///< covariance_scale() at the last change
  UdCovariance<Scalar, size> covariance_;
  Vector<Wide, size> theta_;
  Parameters initial_;
  Parameters reported_;
  Box<double, 5> bounds_;
  Matrix<double, 5> reported_covariance_ = Matrix<double, 5>::Zero();
  Parameters deviations_ = Parameters::Constant(INFINITY);

  bool restart_pending_ = true;
  bool updated_ = false;
  bool model_error_visible_ = false;
  int first_ = 0;  ///< first parameter estimated: 0 with, 3 without the free responses
  std::int64_t tick_ = 0;
  std::int64_t updates_ = 0;
  std::int64_t since_start_ = 0;  ///< of the filters, in updates
  std::int64_t since_change_ = 0;
  std::int64_t changes_ = 0;
  int selector_ = 0;    ///< of the parameters in return_unexcited()
  double scale_ = 1.0;  ///< assumed covariance over the true one, for what is added to it
  Scalar error_{};
};

/// Bound for θ1…θ4 together, from least squares' standard deviations over nominal.
double relative_error_bound(const Vector<double, 5>& deviations);

/// Trusted according to its standard deviations, while these hold.
struct LeastSquaresEstimation {
  using Settings = LeastSquaresSettings;
  template <class Scalar>
  using In = LeastSquaresEstimator<Scalar>;
  static constexpr std::string_view name = "least_squares";
  static constexpr bool fixed_point = false;
  static constexpr std::array values{
      setting_value<Settings, &Settings::forgetting_s>("forgetting_s"),
      setting_value<Settings, &Settings::min_ratio>("min_ratio"),
      setting_value<Settings, &Settings::max_ratio>("max_ratio"),
      setting_value<Settings, &Settings::max_bias_W>("max_bias_W"),
      setting_value<Settings, &Settings::position_noise_m>("position_noise_m")};

  static void set_nominal(Settings& s, const RegressionScale& scale, double max_W) {
    s.scale = scale;
    if (std::isfinite(max_W)) s.max_W = max_W;
  }

  template <class Scalar>
  static void watch(const LeastSquaresEstimator<Scalar>&, ExcitationMonitor&) {}
  template <class Scalar>
  static bool has_new_estimate(const LeastSquaresEstimator<Scalar>& estimator) {
    return estimator.updated();
  }
  template <class Scalar>
  static Estimate estimate(const LeastSquaresEstimator<Scalar>& estimator, const Theta& nominal,
                           const ExcitationMonitor&, double trusted_error) {
    const auto& parameters = estimator.parameters();
    const auto& deviations = estimator.standard_deviations();
    const double bound = relative_error_bound(deviations);
    return {.theta = parameters.template head<4>().cwiseProduct(nominal),
            .prediction_error_W = estimator.error(),
            .relative_error_bound = bound,
            .trusted = bound <= trusted_error && estimator.consistent(),
            .settled = estimator.settled(),
            .bias_W = parameters[4],
            .deviation = deviations.template head<4>().cwiseProduct(nominal),
            .bias_deviation_W = deviations[4]};
  }
};

}  // namespace supercoil::control
