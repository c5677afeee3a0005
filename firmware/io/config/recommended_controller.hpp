// Which controller suits a muscle: one rule for a file that is completed and for a board that runs.
#pragma once

#include <string>

#include "supercoil/control/actuator/parameters.hpp"
#include "supercoil/control/tracking/controller_settings.hpp"

#include "loop/settings.hpp"

namespace supercoil::config {

/// learned_ff with shape_reference, the closest by docs/control.md, behind a reference model that
/// is as quick as the muscle.
struct RecommendedController {
  double bandwidth_rad_per_s = 0.0;
  double pole_rad_per_s = 0.0;  ///< all three of the reference model
  std::string reason;           ///< of law and bandwidth
  std::string model_reason;

  /// Of a [[channel]]'s `controller`.
  std::string literal() const;
  /// Of its `reference_model`.
  std::string model_literal() const;
  /// Whatever else a controller has, it keeps.
  control::ControllerSettings in_place_of(control::ControllerSettings controller) const;
  /// The same law with that bandwidth, or less.
  bool has_bandwidth_of(const control::ControllerSettings& controller) const;
  /// Another law or shaping, or a bandwidth or a pole that is more than a tenth off.
  bool differs_from(const control::ControllerSettings& controller) const;
};

/// Of a board's loop: its tick, and loop_delay_s() of a channel.
struct LoopTime {
  double step_s = 1e-3;
  double delay_s = 1e-3;
};
/// With the margin that LoopTime leaves (docs/setup.md).
RecommendedController recommended_controller(const control::PhysicalParameters& muscle,
                                             const LoopTime& time = {});
/// Likewise, with the bandwidth of the channel's first controller where another one does not
/// promise clearly less.
RecommendedController recommended_controller(const ChannelSettings& channel,
                                             const BoardSettings& board);
/// Why the channel cannot have it, in words; empty: it can.
std::string problem_of(const RecommendedController& suits, const ChannelSettings& channel,
                       double step_s);

}  // namespace supercoil::config
