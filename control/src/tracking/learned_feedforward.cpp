#include "supercoil/control/tracking/learned_feedforward.hpp"

#include "supercoil/control/actuator/conversions.hpp"

namespace supercoil::control {

namespace {

/// Standard deviations of w before anything is learned.
constexpr double linear_deviation = 0.2;
constexpr double other_deviation = 0.3;
constexpr double constant_ratio = 0.67;  ///< of max_W
/// The minimum standard deviation of an observation, over max_W.
constexpr double residual_ratio = 0.0022;
/// An observation's variance over the residual's mean square, averaged over variance_s.
constexpr double variance_ratio = 0.15;
constexpr double variance_s = 4.0;
/// Residual (rms) that a change must exceed, over max_W.
constexpr double floor_ratio = 0.004;
/// The residual's mean square over 4 s is compared with its largest value more than 10 s before.
/// Ratios of 2 to 8 find the same changes (k - 25 % on real_hard at 12 phases); above 4 the
/// wandering of hysteresis on random steps is not taken for a change. November 2026.
constexpr double mismatch_s = 4.0;
constexpr double mismatch_delay_s = 10.0;
constexpr double mismatch_ratio = 8.0;
constexpr double mismatch_floor_ratio = 0.002;  ///< rms, over max_W
/// Limits of the factor by which the schedule may lower and raise the feedback.
constexpr double min_slope = 0.4;
constexpr double max_slope = 3.0;
/// Limits of one change, relative to the weights along it.
constexpr double min_amount = -0.6;
constexpr double max_amount = 1.5;

MotionRegressors::Values linear_muscle() {
  MotionRegressors::Values w = MotionRegressors::Values::Zero();
  w.head<4>().setOnes();
  return w;
}

}  // namespace

template <class Scalar>
LearnedFeedforward<Scalar>::LearnedFeedforward(const LearnedFeedforwardSettings& s, double step_s)
    : settings_(s),
      step_s_(step_s),
      ticks_per_update_(std::max<std::int64_t>(1, std::llround(update_s / step_s))),
      theta_(s.scale.nominal),
      pid_(s.scale, s.bandwidth_rad_per_s, s.derivative_filter_rad_per_s, step_s),
      regressors_(s.scale, s.max_W),
      least_squares_(prior()),
      detector_(detector_settings()),
      mismatch_(mismatch_settings()),
      iterative_(iterative_settings(), step_s),
      period_finder_(step_s),
      share_(share()),
      bandwidth_(bandwidth()),
      follow_step_(step_s / s.follow_s) {
  retune(theta_);
}

template <class Scalar>
typename LeakyLeastSquares<MotionRegressors::count>::Settings LearnedFeedforward<Scalar>::prior()
    const {
  Weights deviation = Weights::Constant(other_deviation);
  deviation.template head<4>().setConstant(linear_deviation);
  deviation[R::constant] = constant_ratio * settings_.max_W;
  return {.prior = linear_muscle(),
          .deviation = deviation,
          .forgetting = std::exp(-period_s() / settings_.forgetting_s)};
}

template <class Scalar>
typename LearnedFeedforward<Scalar>::Detector::Settings
LearnedFeedforward<Scalar>::detector_settings() const {
  typename Detector::Settings s{.period_s = period_s(), .floor_rms = floor_ratio * settings_.max_W};
  s.stretch(slowness(theta_));
  return s;
}

template <class Scalar>
typename LearnedFeedforward<Scalar>::MismatchDetector::Settings
LearnedFeedforward<Scalar>::mismatch_settings() const {
  MismatchDetector::Settings s{.period_s = period_s(),
                               .floor_rms = mismatch_floor_ratio * settings_.max_W};
  s.window_s = mismatch_s;
  s.delay_s = mismatch_delay_s;
  s.ratio = mismatch_ratio;
  s.repeat_s = recovery_s;
  s.stretch(slowness(theta_));
  return s;
}

template <class Scalar>
IterativeLearning::Settings LearnedFeedforward<Scalar>::iterative_settings() const {
  IterativeLearning::Settings s{.period_s = settings_.period_s};
  s.lead_s *= slowness(theta_);
  s.average_s *= slowness(theta_);
  return s;
}

template <class Scalar>
LearnedShare LearnedFeedforward<Scalar>::share() const {
  return {{.period_s = period_s(), .min_W = residual_ratio * settings_.max_W}, slowness(theta_)};
}

template <class Scalar>
BandwidthAdaptation LearnedFeedforward<Scalar>::bandwidth() const {
  const double mass_kg = settings_.scale.moving_mass_kg;
  return BandwidthAdaptation(
      {.max_rad_per_s = feedback_bandwidth(settings_.bandwidth_rad_per_s, theta_, mass_kg),
       .lag_rad_per_s = damping_rate(theta_, mass_kg),
       .step_s = step_s_});
}

template <class Scalar>
void LearnedFeedforward<Scalar>::retune(const Theta& theta) {
  theta_ = theta;
  pid_.set_bandwidth(
      feedback_bandwidth(settings_.bandwidth_rad_per_s, theta, settings_.scale.moving_mass_kg));
  pid_.retune(theta);
  regressors_.retune(theta);
  least_squares_.reset(linear_muscle());
  followed_ = goal_ = validated_ = validated_next_ = linear_muscle();
  validation_updates_ = 0;
  share_ = share();
  bandwidth_ = bandwidth();
  detector_ = Detector(detector_settings());
  mismatch_ = MismatchDetector(mismatch_settings());
  signal_trend_.setZero();
  residual_trend_W_ = 0.0;
  mean_square_W2_ = 0.0;
  recovery_updates_ = 0;
  iterative_ = IterativeLearning(iterative_settings(), step_s_);
  period_finder_.restart();
  filter_smoothing_ = -std::expm1(-regression_pole_rad_per_s / slowness(theta_) * period_s());
}

template <class Scalar>
ModelMotion<double> LearnedFeedforward<Scalar>::motion_of(const LawInput<Scalar>& in) const {
  return {static_cast<double>(in.model.position), static_cast<double>(in.model.velocity),
          static_cast<double>(in.model.acceleration)};
}

template <class Scalar>
void LearnedFeedforward<Scalar>::start(const LawStart<Scalar>& at) {
  pid_.start(at);
  pid_.schedule(to<Scalar>(slope_));
  LawInput<Scalar> now;
  now.position = at.position;
  now.model = at.model;
  regressors_.step(motion_of(now), 0.0);
  const Weights& psi = regressors_.values();
  once_ = twice_ = {psi, static_cast<double>(at.power)};
  sum_.setZero();
  sum_W_ = 0.0;
  error_.restart();
  bandwidth_.restart();
  tick_ = 0;
  settle_updates_ = updates_of(settle_s);
  next_unit_ = units;
  pending_ = -1;
  period_finder_.restart();
  iterative_.set_period(settings_.period_s);
  repeated_W_ = 0.0;
  if (at.hold) pid_.hold(now, at.power, to<Scalar>(followed_.dot(psi)));
}

template <class Scalar>
Scalar LearnedFeedforward<Scalar>::step(const LawInput<Scalar>& in) {
  // The applied power belongs to the motion of the last tick.
  if (settings_.learn) {
    sum_ += regressors_.values();
    sum_W_ += static_cast<double>(in.applied);
    error_.step(static_cast<double>(in.model.position - in.position));
    if (in.limited) note_limit(in);
    if (++tick_ == ticks_per_update_) {
      tick_ = 0;
      while (next_unit_ < units)
        learn(next_unit_++);
      next_unit_ = 0;
    }
    // Spread over the ticks, so that no tick is long.
    const auto due = static_cast<int>((tick_ + 1) * units / ticks_per_update_);
    while (next_unit_ < std::min(due, units))
      learn(next_unit_++);
  }
  pid_.update_derivative(in);
  regressors_.step(motion_of(in), static_cast<double>(in.model_jerk));
  const Weights& psi = regressors_.values();
  if (settings_.learn) {
    const Weights change = (goal_ - followed_) * follow_step_;
    followed_ += change;
    // The feedforward takes this power over from the integral.
    pid_.hand_over_to_feedforward(change.dot(psi));
    slope_ = std::clamp(regressors_.velocity_slope(followed_), min_slope, max_slope);
  }
  if (settings_.adapt_bandwidth)
    bandwidth_.step(static_cast<double>(in.model.position - in.position), in.limited);
  pid_.schedule(to<Scalar>(slope_ * bandwidth_.ratio()));
  if (settings_.find_period) follow_period(static_cast<double>(in.reference));
  feedforward_W_ = followed_.dot(psi) + iterative_.power_W() + repeated_W_;
  const Scalar demanded = pid_.step(in, to<Scalar>(feedforward_W_));
  iterative_.step(static_cast<double>(demanded) - feedforward_W_,
                  !in.limited && upset_updates_ == 0);
  return demanded;
}

/// When a period has ended, or is found again, the power given for it fades out slowly.
template <class Scalar>
void LearnedFeedforward<Scalar>::follow_period(double reference_W) {
  const double before_s = period_finder_.period_s();
  period_finder_.step(reference_W);
  repeated_W_ -= repeated_W_ * step_s_ / fade_s;
  if (period_finder_.period_s() == before_s) return;
  repeated_W_ += iterative_.power_W();
  iterative_.set_period(period_finder_.period_s());
}

/// Nothing is learned from a limited tick. When the feedforward alone exceeds the limit, the muscle
/// cannot make the model's motion, and what follows says nothing about the muscle.
template <class Scalar>
void LearnedFeedforward<Scalar>::note_limit(const LawInput<Scalar>& in) {
  skip_ = true;
  const auto applied_W = static_cast<double>(in.applied);
  const bool more = pid_.demanded() > in.applied;
  if (more ? feedforward_W_ > applied_W : feedforward_W_ < applied_W)
    settle_updates_ = std::max(settle_updates_, updates_of(infeasible_s));
}

template <class Scalar>
void LearnedFeedforward<Scalar>::learn(int unit) {
  if (unit == 0) {
    observe();
  } else if (unit < units - 1) {
    least_squares_.factor((unit - 1) * columns_of_unit, unit * columns_of_unit);
  } else {
    least_squares_.solve();
    goal_ = linear_muscle() + share_.value() * (least_squares_.weights() - linear_muscle());
  }
}

template <class Scalar>
void LearnedFeedforward<Scalar>::observe() {
  const double share = 1.0 / static_cast<double>(ticks_per_update_);
  once_.regressors += filter_smoothing_ * (sum_ * share - once_.regressors);
  once_.power_W += filter_smoothing_ * (sum_W_ * share - once_.power_W);
  twice_.regressors += filter_smoothing_ * (once_.regressors - twice_.regressors);
  twice_.power_W += filter_smoothing_ * (once_.power_W - twice_.power_W);
  error_.update(static_cast<double>(ticks_per_update_), filter_smoothing_, period_s());
  sum_.setZero();
  sum_W_ = 0.0;
  const bool skip = std::exchange(skip_, false);
  settle_updates_ = std::max<std::int64_t>(0, settle_updates_ - 1);
  upset_updates_ = std::max<std::int64_t>(0, upset_updates_ - 1);
  if (skip || settle_updates_ > 0) return;
  const double power_W = twice_.power_W + error_.power_W(regressors_.units());
  const double predicted_W = least_squares_.weights().dot(twice_.regressors);
  if (pending_ < 0) {
    least_squares_.add(twice_.regressors, power_W, variance_W2(power_W - predicted_W));
    recovery_updates_ = std::max<std::int64_t>(0, recovery_updates_ - 1);
  }
  update_share(power_W);
  watch_for_mismatch(power_W - predicted_W);
  watch_for_change(twice_.power_W - predicted_W);
}

/// Validates what was learned by how it predicts the power some seconds later.
template <class Scalar>
void LearnedFeedforward<Scalar>::update_share(double power_W) {
  const double linear_W = linear_muscle().dot(twice_.regressors);
  share_.step(power_W - linear_W, validated_.dot(twice_.regressors) - linear_W,
              upset_updates_ == 0);
  if (--validation_updates_ > 0) return;
  validation_updates_ = updates_of(validation_delay_s);
  validated_ = std::exchange(validated_next_, least_squares_.weights());
}

/// Observations count for less when the model's error is large, so that the weights do not follow
/// each wander of a sticking muscle. After a change everything must be learned again.
template <class Scalar>
double LearnedFeedforward<Scalar>::variance_W2(double residual_W) {
  const double min_W = residual_ratio * settings_.max_W;
  if (recovery_updates_ > 0) {
    mean_square_W2_ = 0.0;
  } else {
    const double share = -std::expm1(-period_s() / (variance_s * slowness(theta_)));
    mean_square_W2_ += share * (residual_W * residual_W - mean_square_W2_);
  }
  return std::max(min_W * min_W, variance_ratio * mean_square_W2_);
}

template <class Scalar>
typename LearnedFeedforward<Scalar>::Weights LearnedFeedforward<Scalar>::along(
    int direction) const {
  Weights d = least_squares_.weights();
  switch (direction) {
    case power_gain:
      d[R::constant] = 0.0;
      return d;
    case load:
      return Weights::Unit(R::constant);
    case cooling:
      d[R::velocity] = d[R::square_rate] = d[R::cube_rate] = d[R::velocity_square] = 0.0;
      break;
    default:
      break;
  }
  d[R::jerk] = d[R::acceleration] = d[R::constant] = d[R::inertia_slope] = 0.0;
  return d;
}

/// After a detected change, and until it is learned, a larger residual is expected.
template <class Scalar>
void LearnedFeedforward<Scalar>::watch_for_mismatch(double residual_W) {
  const auto found = mismatch_.step(MismatchDetector::Signals::Ones(), std::abs(residual_W));
  if (!found || pending_ >= 0 || upset_updates_ > 0) return;
  least_squares_.forget();
  restart_learning();
}

template <class Scalar>
void LearnedFeedforward<Scalar>::restart_learning() {
  share_.restart();
  validated_ = validated_next_ = least_squares_.weights();
  iterative_.forget();
  upset_updates_ = updates_of(upset_s);
  recovery_updates_ = updates_of(recovery_s);
}

template <class Scalar>
void LearnedFeedforward<Scalar>::watch_for_change(double residual_W) {
  typename Detector::Signals signals;
  for (int i = 0; i < directions; ++i)
    signals[i] = along(i).dot(twice_.regressors);
  const double share = period_s() / (change_trend_s * slowness(theta_));
  signal_trend_ += share * (signals - signal_trend_);
  residual_trend_W_ += share * (residual_W - residual_trend_W_);
  const auto found = detector_.step(signals - signal_trend_, residual_W - residual_trend_W_);
  if (pending_ < 0) {
    if (!found) return;
    ++changes_;
    pending_ = *found;
    pending_updates_ = updates_of(change_wait_s);
    return;
  }
  if (--pending_updates_ > 0) return;
  const double highest = pending_ == load ? settings_.max_W / 2.0 : max_amount;
  const double lowest = pending_ == load ? -highest : min_amount;
  least_squares_.move(along(pending_), std::clamp(detector_.amount(pending_), lowest, highest));
  detector_.forget_window();
  restart_learning();
  pending_ = -1;
}

template <class Scalar>
GainValue LearnedFeedforward<Scalar>::gain(std::size_t i) const {
  if (i < FixedPid<Scalar>::gains) return pid_.gain(i);
  switch (i) {
    case 3:
      return {Gain::feedforward, followed_[R::position] * theta_[3]};
    case 4:
      return {Gain::feedforward_velocity, followed_[R::velocity] * theta_[2]};
    case 5:
      return {Gain::feedforward_acceleration, followed_[R::acceleration] * theta_[1]};
    case 6:
      return {Gain::feedforward_jerk,
              followed_[R::jerk] * theta_[0] * settings_.scale.moving_mass_kg};
    default:
      return {Gain::bias, followed_[R::constant]};
  }
}

template class LearnedFeedforward<double>;
template class LearnedFeedforward<float>;

void LearnedFeedforwardLaw::set_nominal(Settings& s, const RegressionScale& scale, double max_W) {
  s.scale = scale;
  if (std::isfinite(max_W)) s.max_W = max_W;
}

std::optional<FixedLaw> LearnedFeedforwardLaw::fixed_law(const Settings& s, const LawContext&,
                                                         const PhysicalParameters& muscle) {
  const Theta theta = theta_from(muscle);
  return fixed_pid_law(theta,
                       feedback_bandwidth(s.bandwidth_rad_per_s, theta, muscle.moving_mass_kg),
                       s.derivative_filter_rad_per_s);
}

void LearnedFeedforwardLaw::add_contradictions(LawProblems& problems, const Settings& s,
                                               const LawContext&) {
  check_bandwidth(problems, s.bandwidth_rad_per_s);
  if (s.period_s > 0.0 && s.period_s < 2.0) {
    problems.add({"period_s", "must be 0 (the reference does not repeat itself) or 2 to 600"});
  }
  if (s.find_period && s.period_s > 0.0)
    problems.add({"find_period", "must be false where period_s is given"});
}

}  // namespace supercoil::control
