// The error of recursive least squares when its noise is white position noise.
#pragma once

#include "supercoil/control/estimation/filtered_regression.hpp"

namespace supercoil::control {

/// The covariance that recursive least squares carries is right for white residuals. These are
/// position noise v through A(s)/Λ', A = θ1 m̂s³ + θ2 s² + θ3 s + θ4, so correlated over seconds.
/// With H = Σφφᵀ (with forgetting) and v white with density S, the covariance of θ is
///   H⁻¹ (S Σ φ'φ'ᵀ + M) H⁻¹,  φ' = φ filtered by A/Λ' (forgotten twice as fast).
/// M is the knowledge without data: H at the prior's information gives the prior's variance.
/// S follows from the residuals' mean square over ∫h², h being the impulse response of A/Λ'. When
/// the model is not right, they contain more than noise: see EstimateDrift.
/// All in double, 100 times a second; it decides nothing.
class EstimateAccuracy {
 public:
  static constexpr int free = 3;
  static constexpr int size = free + 5;  ///< in FilteredRegression's order
  using Parameters = Vector<double, size>;
  using Square = Matrix<double, size>;
  using Derivatives = Vector<double, 5>;

  /// All times and variances > 0; forgetting in (0, 1].
  struct Settings {
    RegressionScale scale;
    double update_s;         ///< between regressions
    double averaging_s;      ///< of the residuals' mean square
    double noise_m2_per_Hz;  ///< expected density of the position's noise (rms² · tick)
    double assumed_W2;       ///< R: the residual variance that least squares assumes
    double forgetting;       ///< of an update
    /// Of the last five: to these their variances grow when nothing excites them.
    Vector<double, 5> unexcited;
  };
  explicit EstimateAccuracy(const Settings& settings);

  /// The regression's filters start at rest.
  void restart_filters();
  /// Nothing is known of θ except these variances.
  void forget(const Parameters& variances);
  /// Nothing is known of the first parameters except these variances.
  void forget_first(const Vector<double, free>& variances);

  /// What one regression showed.
  struct Observation {
    Parameters theta;              ///< over nominal, the bias in W
    double motion_W;               ///< the part of z that motion explains
    Derivatives impulse_response;  ///< FilteredRegression's
    Derivatives step_response;
    double residual_W;
    double scale;  ///< assumed covariance over the true one, for unexcited parameters
  };
  /// One regression, every update_s.
  void step(const Observation& observation);

  /// The muscle has changed: `added` is added to the covariance of the last five. before, after:
  /// their assumed covariance; after must be regular.
  void spread(const Matrix<double, 5>& before, const Matrix<double, 5>& after,
              const Matrix<double, 5>& added);

  /// Mean square of the residual, in W².
  double mean_square() const { return mean_square_W2_; }
  /// The parts of a covariance of θ1…θ4 over nominal and of the bias in W.
  struct Parts {
    Matrix<double, 5> noise;  ///< from the residuals, as if they were position noise
    Matrix<double, 5> prior;
  };
  /// covariance: as assumed by least squares.
  Parts parts(const Square& covariance, const Parameters& theta) const;
  /// Limits a scaled-up covariance to twice the deviations of unexcited parameters.
  Matrix<double, 5> bounded(const Matrix<double, 5>& covariance) const;
  /// True when the residuals' rms is more than twice what the expected noise makes it.
  bool model_error_visible(const Parameters& theta) const {
    return mean_square_W2_ > 4.0 * settings_.noise_m2_per_Hz * noise_gain(theta);
  }

 private:
  using Filter = StateVariableFilter<double, 5, Hold::zero_order>;

  Vector<double, 4> polynomial(const Parameters& theta) const;
  double noise_gain(const Parameters& theta) const;

  Settings settings_;
  Filter motion_;
  Filter impulse_;
  Filter step_;
  Vector<double, 4> weights_;  // of 1, s, s², s³ in A
  Matrix<double, 4> gram_;     // ∫ of the impulse responses of [1, s, s², s³]/Λ', pairwise
  double mean_square_W2_;
  Square prior_ = Square::Zero();  // M
  Square scores_ = Square::Zero();
};

}  // namespace supercoil::control
