#include "supercoil/control/estimation/simplest_change.hpp"

#include <cmath>

#include <Eigen/Cholesky>

namespace supercoil::control {

namespace {

using Factor = Eigen::LDLT<SimplestChange::Square>;

double log_determinant(const Factor& factor) {
  return factor.vectorD().array().log().sum();
}

}  // namespace

void SimplestChange::begin(const Parameters& theta, const Square& covariance,
                           const Directions& along, const Square& all) {
  theta_ = theta;
  covariance_ = covariance;
  along_ = along;
  all_ = all;
}

/// The covariance of θ's move δ is the sum of those of θ before and after, and of the change
/// itself: one more direction adds a matrix of rank one.
std::optional<SimplestChange::Parameters> SimplestChange::explained(
    const Parameters& theta, const Square& covariance) const {
  const Parameters moved = theta - theta_;
  const Square both = covariance_ + covariance;
  Square unchanged = both;
  unchanged.diagonal().array() += other_deviation * other_deviation;
  const Factor factor(unchanged);
  const Parameters weighed = factor.solve(moved);
  const double log_unchanged = log_determinant(factor);
  const Factor any(both + all_);

  Vector<double, kinds + 1> log_likelihood;
  log_likelihood[kinds] = -0.5 * (moved.dot(any.solve(moved)) + log_determinant(any));
  Matrix<double, 5, kinds + 1> candidates;
  candidates.col(kinds) = theta;
  for (int i = 0; i < kinds; ++i) {
    const Parameters along = along_.col(i);
    const Parameters weighed_along = factor.solve(along);
    const double spread = 1.0 + along.dot(weighed_along);
    const Parameters rest = weighed - weighed_along * (along.dot(weighed) / spread);
    log_likelihood[i] = -0.5 * (moved.dot(rest) + log_unchanged + std::log(spread));
    candidates.col(i) = theta - covariance * rest;
  }
  int best = 0;
  const double max_log_likelihood = log_likelihood.maxCoeff(&best);
  const double probability = 1.0 / (log_likelihood.array() - max_log_likelihood).exp().sum();
  // NaN decides nothing either.
  if (!(probability > min_probability)) return std::nullopt;
  return candidates.col(best);
}

}  // namespace supercoil::control
