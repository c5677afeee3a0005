// What has changed, as long as one thing alone explains it.
#pragma once

#include <optional>

#include "supercoil/control/scalar/scalar.hpp"

namespace supercoil::control {

/// After a change least squares leaves every direction open in which muscles change. Until the
/// motion has told them apart, θ lies somewhere between: a load of 0.1 N moved θ2 and θ3 by a
/// quarter for seconds. But a muscle mostly changes in one thing at a time. So how far θ has moved
/// is held against each direction alone and against all of them together, by likelihood, which
/// prefers the narrower one that explains as much.
class SimplestChange {
 public:
  static constexpr int kinds = 4;
  using Parameters = Vector<double, 5>;
  using Square = Matrix<double, 5>;
  using Directions = Matrix<double, 5, kinds>;

  /// θ and its covariance before the change. along: each direction times the standard deviation of
  /// a change; all: the covariance that is added where nothing is known of the kind.
  void begin(const Parameters& theta, const Square& covariance, const Directions& along,
             const Square& all);

  /// θ if the likeliest explanation is true, from what least squares has found since; nothing while
  /// two of them explain it about as well. covariance: regular.
  std::optional<Parameters> explained(const Parameters& theta, const Square& covariance) const;

  /// θ before the change.
  const Parameters& before() const { return theta_; }

 private:
  /// Of each θ besides what it moves along the direction.
  static constexpr double other_deviation = 0.01;
  static constexpr double sure = 0.9;  ///< the likelihood's share at which it is decided

  Parameters theta_ = Parameters::Zero();
  Square covariance_ = Square::Zero();
  Square all_ = Square::Zero();
  Directions along_ = Directions::Zero();
};

}  // namespace supercoil::control
