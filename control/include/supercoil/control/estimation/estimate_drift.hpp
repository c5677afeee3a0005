// How far estimates move beyond what their own covariance allows.
#pragma once

#include <array>
#include <cstdint>

#include "supercoil/control/scalar/scalar.hpp"

namespace supercoil::control {

/// A model that is not quite right fits a little otherwise wherever the muscle is, and no
/// covariance that is computed from residuals predicts by how much. So θ is compared with itself a
/// while ago, in the metric of the covariance that it had then: δᵀD⁻¹δ over the number of
/// directions in which anything was known.
class EstimateDrift {
 public:
  static constexpr int size = 5;
  using Parameters = Vector<double, size>;
  using Square = Matrix<double, size>;

  /// All > 0.
  struct Settings {
    double update_s;       ///< between steps
    double lag_s;          ///< between what is compared: so that the data are others
    double memory_s;       ///< in which a comparison's weight falls to 1/e
    Parameters unexcited;  ///< variances of what nothing excites
  };
  explicit EstimateDrift(const Settings& settings);

  /// One estimate with its covariance, every update_s.
  void step(const Parameters& theta, const Square& covariance);
  /// The muscle has changed: θ is compared with nothing before.
  void forget_past();
  /// Mean of the comparisons; about 1 where the model is right, 0 before there was one.
  double mean_square() const { return mean_square_; }

 private:
  static constexpr std::size_t slots = 8;
  struct Past {
    bool known = false;
    Parameters theta;
    Square information;
    double directions;
  };

  Settings settings_;
  std::int64_t steps_per_slot_;
  std::int64_t steps_ = 0;
  std::size_t slot_ = 0;
  std::array<Past, slots> past_{};
  double mean_square_ = 0.0;
  double comparisons_ = 0.0;
};

}  // namespace supercoil::control
