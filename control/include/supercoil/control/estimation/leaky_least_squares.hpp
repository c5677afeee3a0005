// Recursive least squares with forgetting whose unexcited directions return to a prior.
#pragma once

#include <algorithm>
#include <cmath>

#include "supercoil/control/scalar/scalar.hpp"

namespace supercoil::control {

/// Minimises Σ λᵃ (z − wᵀψ)²/R + (w − w₀)ᵀP₀⁻¹(w − w₀) over w, a being an observation's age in
/// updates and R its variance: in information form, M ← λM + ψψᵀ/R + (1 − λ)P₀⁻¹. A covariance that
/// grows without excitation has to be capped as a whole, and learning starves; here an unexcited
/// direction returns to w₀ while the others learn. Factoring M costs N/3 times as much as all the
/// rest, so the caller may spread it over ticks: add(), factor() for all columns in order, then
/// solve().
template <int N>
class LeakyLeastSquares {
 public:
  using Weights = Vector<double, N>;

  /// The prior, and how fast it comes back.
  struct Settings {
    Weights prior;                    ///< w₀
    Weights deviation;                ///< √ of the diagonal P₀, > 0
    double forgetting;                ///< λ, per update, in (0, 1]
    double kept_after_change = 0.03;  ///< of the information
  };

  explicit LeakyLeastSquares(const Settings& s)
      : settings_(s), prior_information_(s.deviation.cwiseProduct(s.deviation).cwiseInverse()) {
    reset(s.prior);
  }

  /// Nothing is known but the prior. weights: the initial ones, and the new prior.
  void reset(const Weights& weights) {
    settings_.prior = weights;
    weights_ = weights;
    information_ = prior_information_.asDiagonal();
    moment_ = prior_information_.cwiseProduct(weights);
  }

  /// One observation z of regressors psi, finite. variance: R, > 0.
  void add(const Weights& psi, double z, double variance) {
    const double leak = 1.0 - settings_.forgetting;
    const Weights scaled = psi / variance;
    for (int j = 0; j < N; ++j) {
      for (int i = j; i < N; ++i)
        information_(i, j) = settings_.forgetting * information_(i, j) + scaled[i] * psi[j];
      information_(j, j) += leak * prior_information_[j];
    }
    moment_ = settings_.forgetting * moment_ + scaled * z +
              leak * prior_information_.cwiseProduct(settings_.prior);
  }

  /// Computes Cholesky's columns [first, last) of the information, after all earlier columns.
  void factor(int first, int last) {
    for (int j = first; j < last; ++j) {
      double pivot = information_(j, j);
      for (int k = 0; k < j; ++k)
        pivot -= factor_(j, k) * factor_(j, k);
      // The leak keeps the information positive; rounding might not.
      factor_(j, j) = std::sqrt(std::max(pivot, 1e-9 * information_(j, j)));
      const double inverse = 1.0 / factor_(j, j);
      for (int i = j + 1; i < N; ++i) {
        double sum = information_(i, j);
        for (int k = 0; k < j; ++k)
          sum -= factor_(i, k) * factor_(j, k);
        factor_(i, j) = sum * inverse;
      }
    }
  }

  /// Computes the weights from what was added before the factoring began.
  void solve() {
    for (int i = 0; i < N; ++i) {
      double sum = moment_[i];
      for (int k = 0; k < i; ++k)
        sum -= factor_(i, k) * weights_[k];
      weights_[i] = sum / factor_(i, i);
    }
    for (int i = N - 1; i >= 0; --i) {
      double sum = weights_[i];
      for (int k = i + 1; k < N; ++k)
        sum -= factor_(k, i) * weights_[k];
      weights_[i] = sum / factor_(i, i);
    }
  }

  /// The muscle has changed in an unknown way: w stays, and little of the information is kept.
  void forget() {
    const double kept = settings_.kept_after_change;
    information_ = (information_ * kept).eval();
    information_.diagonal() += (1.0 - kept) * lost * prior_information_;
    moment_ = information_.template selfadjointView<Eigen::Lower>() * weights_;
  }

  /// The muscle has changed by `amount` along `direction`: w is moved there, the information along
  /// it is lost, and little of the rest is kept.
  void move(const Weights& direction, double amount) {
    weights_ += amount * direction;
    forget();
    const Weights along = information_.template selfadjointView<Eigen::Lower>() * direction;
    const double spread = 1.0 / regained_variance + direction.dot(along);
    for (int j = 0; j < N; ++j) {
      for (int i = j; i < N; ++i)
        information_(i, j) -= along[i] * along[j] / spread;
    }
    moment_ = information_.template selfadjointView<Eigen::Lower>() * weights_;
  }

  const Weights& weights() const { return weights_; }

 private:
  static constexpr double regained_variance = 0.1;  ///< along a change's direction
  static constexpr double lost = 0.01;  ///< of the prior's pull, so that w stays where it was moved

  Settings settings_;
  Weights prior_information_;
  Weights weights_;
  Weights moment_;                                        // Σ ψz/R and the prior's
  Matrix<double, N> information_;                         // lower triangle
  Matrix<double, N> factor_ = Matrix<double, N>::Zero();  // lower triangle
};

}  // namespace supercoil::control
