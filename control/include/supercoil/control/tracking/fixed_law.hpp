// What a controller does to small errors while nothing adapts.
#pragma once

#include <array>
#include <optional>

#include "supercoil/control/actuator/parameters.hpp"
#include "supercoil/control/linear/polynomial.hpp"

namespace supercoil::control {

/// u = θ1ᵀα/λ u + (θ2ᵀα/λ + θ3) x: direct adaptation while θ rests.
struct FilteredFeedback {
  Polynomial<2> lambda{};                       ///< λ(s), monic
  std::array<double, 2> on_power{};             ///< θ1ᵀα, ascending
  std::array<double, 2> on_position_W_per_m{};  ///< θ2ᵀα, ascending
  double direct_W_per_m = 0.0;                  ///< θ3
};

/// Kp + Ki/s + Kd s/(s/ω + 1)² on the error, plus filtered feedback. Holds for small errors within
/// the law's limits.
struct FixedLaw {
  double proportional_W_per_m = 0.0;
  double integral_W_per_m_s = 0.0;
  double derivative_Ws_per_m = 0.0;
  double derivative_filter_rad_per_s = 60.0;
  std::optional<FilteredFeedback> filtered{};
};

/// The law of a FixedPid tuned for the muscle.
inline FixedLaw fixed_pid_law(const Theta& theta, double bandwidth_rad_per_s,
                              double filter_rad_per_s) {
  const Theta gains = theta * bandwidth_rad_per_s;
  return {gains[2], gains[3], gains[1], filter_rad_per_s};
}

}  // namespace supercoil::control
