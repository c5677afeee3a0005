// How far estimates move beyond what their own covariance allows.
#pragma once

#include <array>
#include <cstdint>

#include "supercoil/control/scalar/scalar.hpp"

namespace supercoil::control {

/// A model that is not quite right fits slightly differently wherever the muscle is, and no
/// covariance computed from residuals predicts by how much. So θ is compared with its own earlier
/// value, in the metric of its covariance at that time: δᵀD⁻¹δ over the number of directions in
/// which anything was known.
class EstimateDrift {
 public:
  static constexpr int size = 5;
  using Parameters = Vector<double, size>;
  using Square = Matrix<double, size>;

  /// All > 0.
  struct Settings {
    double update_s;       ///< between steps
    double lag_s;          ///< between compared estimates, so that their data differ
    double memory_s;       ///< in which a comparison's weight falls to 1/e
    Parameters unexcited;  ///< variances of what nothing excites
  };
  explicit EstimateDrift(const Settings& settings);

  /// One estimate with its covariance, every update_s.
  void step(const Parameters& theta, const Square& covariance);
  /// The muscle has changed: θ is not compared with earlier values.
  void forget_past();
  /// Mean of the comparisons; about 1 when the model is right, 0 before the first.
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
