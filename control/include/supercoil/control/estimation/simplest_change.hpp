// What has changed, if a single change explains it.
#pragma once

#include <optional>

#include "supercoil/control/scalar/scalar.hpp"

namespace supercoil::control {

/// After a change least squares leaves open every direction in which muscles change. Until the
/// motion has told them apart, θ lies somewhere in between: a load of 0.1 N moved θ2 and θ3 by a
/// quarter for seconds. But a muscle mostly changes in one way at a time. So the move of θ is
/// compared with each direction alone and with all of them together, by likelihood, which prefers
/// the narrower one that explains as much.
class SimplestChange {
 public:
  static constexpr int kinds = 4;
  using Parameters = Vector<double, 5>;
  using Square = Matrix<double, 5>;
  using Directions = Matrix<double, 5, kinds>;

  /// θ and its covariance before the change. along: each direction times the standard deviation of
  /// a change; all: the covariance that is added when the kind of change is unknown.
  void begin(const Parameters& theta, const Square& covariance, const Directions& along,
             const Square& all);

  /// θ if the likeliest explanation is true, from what least squares has found since; empty while
  /// two explanations are about equally likely. covariance: regular.
  std::optional<Parameters> explained(const Parameters& theta, const Square& covariance) const;

  /// θ before the change.
  const Parameters& before() const { return theta_; }

 private:
  /// Deviation of each θ in addition to its move along the direction.
  static constexpr double other_deviation = 0.01;
  static constexpr double min_probability = 0.9;  ///< at which an explanation is accepted

  Parameters theta_ = Parameters::Zero();
  Square covariance_ = Square::Zero();
  Square all_ = Square::Zero();
  Directions along_ = Directions::Zero();
};

}  // namespace supercoil::control
