// What a controller does to small errors while nothing adapts.
#pragma once

#include <array>
#include <optional>

#include "supercoil/control/tracking/controller.hpp"

namespace supercoil::control {

/// u = θ1ᵀα/λ u + (θ2ᵀα/λ + θ3) x of direct adaptation, whose θ rests.
struct FilteredFeedback {
  Polynomial<2> lambda{};                       ///< λ(s), monic
  std::array<double, 2> on_power{};             ///< θ1ᵀα, ascending
  std::array<double, 2> on_position_W_per_m{};  ///< θ2ᵀα, ascending
  double direct_W_per_m = 0.0;                  ///< θ3
};

/// Kp + Ki/s + Kd s/(s/ω + 1)² on the error, and filtered feedback beside it. On small errors and
/// within the law's limits.
struct FixedLaw {
  double proportional_W_per_m = 0.0;
  double integral_W_per_m_s = 0.0;
  double derivative_Ws_per_m = 0.0;
  double derivative_filter_rad_per_s = 60.0;
  std::optional<FilteredFeedback> filtered{};
};

/// True for laws whose feedback changes while they run.
constexpr bool adapts(ControllerKind kind) {
  return kind == ControllerKind::mrac || kind == ControllerKind::mrac_ls;
}

/// With the gains that follow from a muscle; of a law that adapts, with the θ* that matches it
/// (mrac_matching.hpp). Empty in open loop, and where no θ matches.
std::optional<FixedLaw> fixed_law(const ControllerSettings& settings,
                                  const PhysicalParameters& muscle);

}  // namespace supercoil::control
