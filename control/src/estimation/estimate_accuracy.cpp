#include "supercoil/control/estimation/estimate_accuracy.hpp"

#include <algorithm>

#include <Eigen/LU>

namespace supercoil::control {

namespace {

/// A residual of more standard deviations comes from a change of the muscle, not from noise.
constexpr double max_deviations = 3.0;

/// ∫ of the impulse responses of [1, s, s², s³]/Λ', which have decayed after 30 s, pairwise.
Matrix<double, 4> gram_of_impulses() {
  constexpr double step_s = 2e-3;
  StateVariableFilter<double, 5, Hold::zero_order> filter(steep_lambda, step_s);
  Vector<double, 5> impulse = Vector<double, 5>::Zero();
  impulse[4] = steep_lambda_gain;
  filter.set(impulse, 0.0);
  Matrix<double, 4> gram = Matrix<double, 4>::Zero();
  for (int k = 0; k < 15'000; ++k) {
    filter.step(0.0);
    const Vector<double, 4> h = filter.state().head<4>();
    gram += h * h.transpose() * step_s;
  }
  return gram;
}

}  // namespace

EstimateAccuracy::EstimateAccuracy(const Settings& settings)
    : settings_(settings),
      motion_(steep_lambda, settings.update_s),
      impulse_(steep_lambda, settings.update_s),
      step_(steep_lambda, settings.update_s),
      gram_(gram_of_impulses()) {
  const Theta& nominal = settings.scale.nominal;
  weights_ << nominal[3], nominal[2], nominal[1], nominal[0] * settings.scale.moving_mass_kg;
  mean_square_W2_ = settings.noise_m2_per_Hz * noise_gain(Parameters::Ones());
}

void EstimateAccuracy::restart_filters() {
  motion_.settle(0.0);
  impulse_.settle(0.0);
  step_.settle(0.0);
}

void EstimateAccuracy::forget(const Parameters& variances) {
  // A prior of variance C0 enters H as R/C0, and must give C0 by itself: H⁻¹ (R²/C0) H⁻¹.
  const double square = settings_.assumed_W2 * settings_.assumed_W2;
  prior_.setZero();
  for (int i = 0; i < size; ++i)
    prior_(i, i) = variances[i] > 0.0 ? square / variances[i] : 0.0;
  scores_.setZero();
}

void EstimateAccuracy::forget_first(const Vector<double, free>& variances) {
  const Matrix<double, 5> prior = prior_.bottomRightCorner<5, 5>();
  const Matrix<double, 5> scores = scores_.bottomRightCorner<5, 5>();
  Parameters all = Parameters::Zero();
  all.head<free>() = variances;
  forget(all);
  prior_.bottomRightCorner<5, 5>() = prior;
  scores_.bottomRightCorner<5, 5>() = scores;
}

void EstimateAccuracy::spread(const Matrix<double, 5>& before, const Matrix<double, 5>& after,
                              const Matrix<double, 5>& added) {
  const Matrix<double, 5> inverse = before / settings_.assumed_W2;  // H⁻¹
  const Matrix<double, 5> next = after.inverse() * settings_.assumed_W2;
  const Matrix<double, 5> through = next * inverse;
  const Matrix<double, 5> scores = scores_.bottomRightCorner<5, 5>();
  const Matrix<double, 5> prior = prior_.bottomRightCorner<5, 5>();
  scores_.bottomRightCorner<5, 5>() = through * scores * through.transpose();
  prior_.bottomRightCorner<5, 5>() = through * prior * through.transpose() + next * added * next;
}

Vector<double, 4> EstimateAccuracy::polynomial(const Parameters& theta) const {
  return theta.segment<4>(free).reverse().cwiseProduct(weights_);
}

double EstimateAccuracy::noise_gain(const Parameters& theta) const {
  const Vector<double, 4> a = polynomial(theta);
  return a.dot(gram_ * a);
}

void EstimateAccuracy::step(const Observation& observation) {
  const Vector<double, 4> a = polynomial(observation.theta);
  motion_.step(observation.motion_W);
  impulse_.step(a.dot(observation.impulse_response.head<4>()));
  step_.step(a.dot(observation.step_response.head<4>()));
  Parameters filtered;
  filtered << impulse_.state().head<free>().reverse(),
      motion_.state().head<4>().cwiseProduct(weights_).reverse(), step_.state()[0];
  filtered *= steep_lambda_gain;
  const double kept = settings_.forgetting * settings_.forgetting;
  scores_ = (scores_ + filtered * filtered.transpose()) * kept;
  prior_ *= kept;
  const double assumed = settings_.assumed_W2 / observation.scale;
  prior_.diagonal().tail<5>() +=
      settings_.unexcited.cwiseInverse() * ((1.0 - kept) * assumed * assumed);

  // It begins at its expected value: while θ is found, residuals are smaller than the noise.
  const double max_W2 = max_deviations * max_deviations * mean_square_W2_;
  const double share = settings_.update_s / settings_.averaging_s;
  mean_square_W2_ +=
      (std::min(observation.residual_W * observation.residual_W, max_W2) - mean_square_W2_) * share;
}

EstimateAccuracy::Parts EstimateAccuracy::parts(const Square& covariance,
                                                const Parameters& theta) const {
  const double density = mean_square_W2_ / noise_gain(theta);
  const Matrix<double, 5, size> inverse =
      covariance.bottomRows<5>() / settings_.assumed_W2;  // of H⁻¹
  return {inverse * scores_ * inverse.transpose() * (density / settings_.update_s),
          inverse * prior_ * inverse.transpose()};
}

Matrix<double, 5> EstimateAccuracy::bounded(const Matrix<double, 5>& covariance) const {
  // Combined like two independent observations.
  const Matrix<double, 5> most = (4.0 * settings_.unexcited).asDiagonal();
  const Matrix<double, 5> both = covariance + most;
  return covariance * both.inverse() * most;
}

}  // namespace supercoil::control
