// A Kalman filter of the muscle's state and parameters, for any kind of prediction.
#pragma once

#include <cstdint>

#include "supercoil/control/estimation/parametric_model.hpp"

#include "estimators/muscle_state.hpp"

namespace supercoil::host_sim::estimators {

struct Belief {
  State mean;
  Covariance covariance;
};

/// Moves a belief by a tick. False: the covariance is not positive definite.
using Predict = bool (*)(Belief& belief, double moving_mass_kg, double power_W, double step_s);

/// Extended Kalman filter: the covariance moves by the motion's derivative at the mean.
bool predict_extended(Belief& belief, double moving_mass_kg, double power_W, double step_s);

/// Unscented Kalman filter: 2n + 1 states about the mean move, and their mean and covariance are
/// taken (Julier & Uhlmann 2004).
bool predict_unscented(Belief& belief, double moving_mass_kg, double power_W, double step_s);

/// Found by trials on the paper's muscle (docs/estimators.md).
struct FilterSettings {
  control::RegressionScale scale;
  control::Theta initial = scale.nominal;  ///< θ(0)
  double min_ratio = 0.2;                  ///< θ is kept between these ratios of its nominal
  double max_ratio = 5.0;
  double position_noise_m = 10e-6;  ///< rms, white
  /// What the linearisation leaves out counts as noise too: this ratio of position · half the
  /// variance of the logarithms. Without it the filter becomes sure of what it learned while it was
  /// wrong.
  double remainder_ratio = 0.1;
  /// Time in which an observation's weight falls to 1/e; infinity: never. After the start or a
  /// change it is the time since then, but at least first_forgetting_s: observations from when the
  /// filter was wrong are forgotten.
  double forgetting_s = 30.0;
  double first_forgetting_s = 3.0;
  /// Standard deviations at the start, the muscle being at rest.
  double prior_logarithm = 1.0;
  double prior_bias_W = 0.5;
  double prior_velocity_m_per_s = 1e-4;
  double prior_acceleration_m_per_s2 = 1e-3;
  /// The muscle has changed when the innovations' mean square, over 0.1 s, is more than this many
  /// times what the covariance says.
  double change_ratio = 3.0;
  double blind_s = 1.0;  ///< after the start or a change, no change is looked for
  /// Standard deviations that a change adds.
  double changed_logarithm = 0.3;
  double changed_bias_W = 0.3;
  double changed_acceleration_m_per_s2 = 1.0;
};

class MuscleFilter {
 public:
  /// step_s: the sampling period in seconds, > 0.
  MuscleFilter(Predict predict, const FilterSettings& settings, double step_s);

  /// One tick: this tick's position, and the power that acted since the last one. A position that
  /// is not finite is absent: the filter then only predicts. A power that is not finite is replaced
  /// by the last finite one.
  void step(double position_m, double power_W);

  const Belief& belief() const { return belief_; }
  control::Theta theta() const { return theta_of(belief_.mean); }
  /// Of θ, relative.
  control::Theta standard_deviations() const;
  /// Changes of the muscle that were detected.
  std::int64_t changes() const { return changes_; }
  /// How often the filter restarted because rounding had made the covariance indefinite.
  std::int64_t restarts() const { return restarts_; }

 private:
  Covariance prior() const;
  void correct(double position_m);
  void forget();
  void detect_change(double normalised_square);

  Predict predict_;
  FilterSettings settings_;
  double step_s_;
  Belief belief_;
  State min_;
  State max_;
  double power_W_ = 0.0;
  bool begun_ = false;
  double since_s_ = 0.0;      ///< the start or the last change
  double mean_square_ = 1.0;  ///< of normalised innovations, low-passed
  std::int64_t changes_ = 0;
  std::int64_t restarts_ = 0;
};

}  // namespace supercoil::host_sim::estimators
