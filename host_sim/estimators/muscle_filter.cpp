#include "estimators/muscle_filter.hpp"

#include <algorithm>
#include <limits>

namespace supercoil::host_sim::estimators {

namespace {

constexpr double change_mean_s = 0.1;

}  // namespace

MuscleFilter::MuscleFilter(Predict predict, const FilterSettings& settings, double step_s)
    : predict_(predict),
      settings_(settings),
      step_s_(step_s),
      belief_{state_of(settings.initial), Covariance::Zero()},
      min_(State::Constant(-std::numeric_limits<double>::infinity())),
      max_(State::Constant(INFINITY)) {
  const State nominal = state_of(settings.scale.nominal);
  for (int i = at_ln_theta_1; i < at_bias; ++i) {
    min_[i] = nominal[i] + std::log(settings.min_ratio);
    max_[i] = nominal[i] + std::log(settings.max_ratio);
  }
  belief_.mean = belief_.mean.cwiseMax(min_).cwiseMin(max_);
  belief_.covariance = prior();
}

Covariance MuscleFilter::prior() const {
  State deviations = State::Constant(settings_.prior_logarithm);
  deviations[at_acceleration] = settings_.prior_acceleration_m_per_s2;
  deviations[at_position] = settings_.position_noise_m;
  deviations[at_velocity] = settings_.prior_velocity_m_per_s;
  deviations[at_bias] = settings_.prior_bias_W;
  return deviations.cwiseAbs2().asDiagonal();
}

void MuscleFilter::step(double position_m, double power_W) {
  if (std::isfinite(power_W)) power_W_ = power_W;
  const bool has_reading = std::isfinite(position_m);
  if (!begun_) {
    if (!has_reading) return;
    begun_ = true;
    belief_.mean[at_position] = position_m;
    return;
  }
  if (!predict_(belief_, settings_.scale.moving_mass_kg, power_W_, step_s_)) {
    ++restarts_;
    belief_.covariance = prior();
  }
  since_s_ += step_s_;
  if (has_reading) {
    forget();
    correct(position_m);
  }
}

void MuscleFilter::correct(double position_m) {
  Covariance& p = belief_.covariance;
  const double remainder_m = settings_.remainder_ratio * 0.5 *
                             p.diagonal().segment<parameter_size>(at_ln_theta_1).sum() *
                             std::abs(belief_.mean[at_position]);
  const double noise =
      settings_.position_noise_m * settings_.position_noise_m + remainder_m * remainder_m;
  const double innovation = position_m - belief_.mean[at_position];
  const double variance = p(at_position, at_position) + noise;
  const State gain = p.col(at_position) / variance;
  belief_.mean += gain * innovation;
  belief_.mean = belief_.mean.cwiseMax(min_).cwiseMin(max_);
  // Joseph's form, for a measurement of one state: it stays symmetric and positive.
  Covariance left = Covariance::Identity();
  left.col(at_position) -= gain;
  p = (left * p * left.transpose() + noise * gain * gain.transpose()).eval();
  p = (0.5 * (p + p.transpose())).eval();
  detect_change(innovation * innovation / variance);
}

/// Fading memory: the whole covariance grows, as if all that was seen before were noisier.
void MuscleFilter::forget() {
  const double memory_s =
      std::min(settings_.forgetting_s, std::max(settings_.first_forgetting_s, since_s_));
  belief_.covariance *= std::exp(step_s_ / memory_s);
  // Without excitation it would grow without limit.
  const double max_variance =
      belief_.covariance.diagonal().segment<parameter_size>(at_ln_theta_1).maxCoeff();
  const double limit = settings_.prior_logarithm * settings_.prior_logarithm;
  if (max_variance > limit) belief_.covariance *= limit / max_variance;
}

void MuscleFilter::detect_change(double normalised_square) {
  mean_square_ += (normalised_square - mean_square_) * step_s_ / change_mean_s;
  if (since_s_ < settings_.blind_s || mean_square_ < settings_.change_ratio) return;
  ++changes_;
  since_s_ = 0.0;
  mean_square_ = 1.0;
  State added = State::Zero();
  added.segment<parameter_size>(at_ln_theta_1).setConstant(settings_.changed_logarithm);
  added[at_bias] = settings_.changed_bias_W;
  // When the stiffness jumps, so does the acceleration.
  added[at_acceleration] = settings_.changed_acceleration_m_per_s2;
  belief_.covariance.diagonal() += added.cwiseAbs2();
}

control::Theta MuscleFilter::standard_deviations() const {
  return belief_.covariance.diagonal().segment<parameter_size>(at_ln_theta_1).cwiseSqrt();
}

}  // namespace supercoil::host_sim::estimators
