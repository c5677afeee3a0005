// Feedforward that learns the power that its own motion takes, with a scheduled PID for the rest.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "supercoil/control/estimation/change_detector.hpp"
#include "supercoil/control/estimation/leaky_least_squares.hpp"
#include "supercoil/control/tracking/bandwidth_adaptation.hpp"
#include "supercoil/control/tracking/error_power.hpp"
#include "supercoil/control/tracking/fixed_pid.hpp"
#include "supercoil/control/tracking/iterative_learning.hpp"
#include "supercoil/control/tracking/learned_share.hpp"
#include "supercoil/control/tracking/motion_regressors.hpp"
#include "supercoil/control/tracking/period_finder.hpp"

namespace supercoil::control {

/// u = w̄ᵀψ + g (Kp e + Kd ė + Ki ∫e), e = xm − x, with ψ the MotionRegressors of the reference
/// model's motion. w is learned by least squares from the applied power and the ErrorPower, all
/// filtered by 1/(s/ωf + 1)²: what the feedback had to add in one pass, the feedforward gives in
/// the next. The model's motion is known exactly, so ψ is free of noise. w̄ follows the linear
/// muscle plus as much of what was learned beyond it as has proved itself (LearnedShare).
///
/// The PID's gains are those of FixedPid at the feedback bandwidth that the muscle allows. g
/// follows the learned slope of power over velocity, since a cold muscle needs more power per metre
/// than a hot one, and BandwidthAdaptation when little but noise is left in the error. A
/// ChangeDetector detects changes of stiffness, gain, load and cooling; w is moved at once along
/// the detected direction, and then learned again. A change in any other direction leaves a larger
/// residual than ever before: w is then learned again from its present value. When the reference
/// repeats itself, IterativeLearning adds what is still missing.
struct LearnedFeedforwardSettings {
  RegressionScale scale;                      ///< of the nominal muscle
  double max_W = 4.5;                         ///< > 0: the scale of powers
  double bandwidth_rad_per_s = 8.0;           ///< maximum
  double derivative_filter_rad_per_s = 80.0;  ///< of the error, twice this pole
  double follow_s = 0.5;                      ///< time constant with which w̄ follows
  double forgetting_s = 60.0;                 ///< in which an observation's weight falls to 1/e
  bool learn = true;                          ///< otherwise w stays that of the linear muscle
  double period_s = 0.0;        ///< in which the reference repeats itself; 0: it does not
  bool find_period = false;     ///< when none is given
  bool adapt_bandwidth = true;  ///< lower it when only noise is left in the error
};

/// The law of LearnedFeedforwardSettings, in float or double. Positions and powers are in watts at
/// rest (LawInput).
template <class Scalar>
class LearnedFeedforward {
  static_assert(std::is_floating_point_v<Scalar>, "information spans more than fixed point does");

 public:
  using Weights = MotionRegressors::Values;

  LearnedFeedforward(const LearnedFeedforwardSettings& s, double step_s);

  /// The muscle was identified: w begins again from its θ. Not while the law runs.
  void retune(const Theta& theta);

  /// Starts with the muscle moving like its model. To hold a power, the integral becomes that power
  /// less the rest; otherwise zero.
  void start(const LawStart<Scalar>& at);

  void slow_down() {
    pid_.slow_down();
    bandwidth_.scale(oscillation_gain_ratio);
  }

  /// Returns the demanded power.
  Scalar step(const LawInput<Scalar>& in);

  static constexpr std::size_t gains = FixedPid<Scalar>::gains + 5;
  GainValue gain(std::size_t i) const;

  /// w̄: 1 for each θ of the linear muscle, the constant in W, 0 for all else.
  const Weights& weights() const { return followed_; }
  /// Changes of the muscle since construction.
  std::int64_t changes() const { return changes_; }

 private:
  using R = MotionRegressors;
  enum Direction : int { stiffness, power_gain, load, cooling, directions };
  using Detector = ChangeDetector<directions>;
  using MismatchDetector = ChangeDetector<1>;

  struct LowPass {
    Weights regressors = Weights::Zero();
    double power_W = 0.0;
  };

  LeakyLeastSquares<R::count>::Settings prior() const;
  typename Detector::Settings detector_settings() const;
  typename MismatchDetector::Settings mismatch_settings() const;
  IterativeLearning::Settings iterative_settings() const;
  LearnedShare share() const;
  BandwidthAdaptation bandwidth() const;
  double period_s() const { return step_s_ * static_cast<double>(ticks_per_update_); }
  /// The number of updates in a time specified for a typical muscle, scaled to this one.
  std::int64_t updates_of(double usual_s) const {
    return std::llround(usual_s * slowness(theta_) / period_s());
  }
  void follow_period(double reference_W);
  void note_limit(const LawInput<Scalar>& in);
  ModelMotion<double> motion_of(const LawInput<Scalar>& in) const;
  void observe();
  void learn(int unit);
  double variance_W2(double residual_W);
  void update_share(double power_W);
  void watch_for_mismatch(double residual_W);
  void watch_for_change(double residual_W);
  void restart_learning();
  Weights along(int direction) const;

  /// The units of one update: the observation, the factoring in steps of three columns, the
  /// solution.
  static constexpr int columns_of_unit = 3;
  static constexpr int units = 2 + R::count / columns_of_unit;
  static_assert(R::count % columns_of_unit == 0);
  static constexpr double update_s = 0.01;
  static constexpr double regression_pole_rad_per_s = 3.0;
  /// Time in which the filters forget their initial state.
  static constexpr double settle_s = 3.0;
  /// Time in which they forget most of a motion that the muscle could not make.
  static constexpr double infeasible_s = 0.5;
  static constexpr double change_wait_s = 1.0;
  /// Time constant with which the power of an ended period fades, so that the integral can follow.
  static constexpr double fade_s = 1.0;
  /// A change is faster than this; most of the model's error is slower.
  static constexpr double change_trend_s = 0.7;
  /// The validated weights are this old, and up to twice as old.
  static constexpr double validation_delay_s = 5.0;
  /// For this time after a change nothing is repeated or validated. With 10 s the feedback's work
  /// during relearning was repeated: 5.6 instead of 1.7 µm (a muscle believed 30 % off).
  static constexpr double upset_s = 30.0;
  static constexpr double recovery_s = 60.0;

  LearnedFeedforwardSettings settings_;
  double step_s_;
  std::int64_t ticks_per_update_;
  Theta theta_;
  FixedPid<Scalar> pid_;
  MotionRegressors regressors_;
  LeakyLeastSquares<R::count> least_squares_;
  Detector detector_;
  MismatchDetector mismatch_;  ///< of no direction
  IterativeLearning iterative_;
  PeriodFinder period_finder_;
  double repeated_W_ = 0.0;  ///< of an ended period; fades
  LearnedShare share_;
  ErrorPower error_;
  BandwidthAdaptation bandwidth_;
  double follow_step_;
  double filter_smoothing_ = 0.0;

  Weights followed_;  // w̄
  Weights goal_;      // of w̄
  Weights validated_;
  Weights validated_next_;
  std::int64_t validation_updates_ = 0;  // before the next ones
  double slope_ = 1.0;
  Weights sum_ = Weights::Zero();  // of ψ since the last update
  double sum_W_ = 0.0;
  LowPass once_;
  LowPass twice_;
  double feedforward_W_ = 0.0;       // of the last tick
  bool skip_ = false;                // the power was limited since the last update
  std::int64_t upset_updates_ = 0;   // until the motion is repeated again after a change
  std::int64_t settle_updates_ = 0;  // until the filters hold the muscle's own motion
  int pending_ = -1;                 // the direction of a change that is being measured
  std::int64_t pending_updates_ = 0;
  std::int64_t tick_ = 0;
  int next_unit_ = units;
  std::int64_t changes_ = 0;
  double mean_square_W2_ = 0.0;        // of the residual
  std::int64_t recovery_updates_ = 0;  // left of those after a change
  typename Detector::Signals signal_trend_ = Detector::Signals::Zero();
  double residual_trend_W_ = 0.0;
};

extern template class LearnedFeedforward<double>;
extern template class LearnedFeedforward<float>;

/// `learned_ff`: how LearnedFeedforward is named, set, made and checked (LawDefinition).
struct LearnedFeedforwardLaw : LawDefaults {
  using Settings = LearnedFeedforwardSettings;
  template <class Scalar>
  using In = LearnedFeedforward<Scalar>;
  static constexpr std::string_view name = "learned_ff";
  static constexpr bool fixed_point = false;
  static constexpr std::array values{
      setting_value<Settings, &Settings::bandwidth_rad_per_s>("bandwidth_rad_per_s"),
      setting_value<Settings, &Settings::derivative_filter_rad_per_s>(
          "derivative_filter_rad_per_s"),
      setting_value<Settings, &Settings::follow_s>("follow_s"),
      setting_value<Settings, &Settings::forgetting_s>("forgetting_s"),
      setting_value<Settings, &Settings::learn>("learn"),
      setting_value<Settings, &Settings::period_s>("period_s"),
      setting_value<Settings, &Settings::find_period>("find_period"),
      setting_value<Settings, &Settings::adapt_bandwidth>("adapt_bandwidth")};

  template <class Scalar>
  static LearnedFeedforward<Scalar> make(const Settings& s, const LawContext&, double step_s) {
    return {s, step_s};
  }
  static std::optional<FixedLaw> fixed_law(const Settings& s, const LawContext& context,
                                           const PhysicalParameters& muscle);
  static void add_contradictions(LawProblems& problems, const Settings& s,
                                 const LawContext& context);
  static void set_nominal(Settings& s, const RegressionScale& scale, double max_W);
};

}  // namespace supercoil::control
