// Which controller suits a muscle: one rule for completing a file and for a running board.
#pragma once

#include <string>

#include "supercoil/control/actuator/parameters.hpp"
#include "supercoil/control/tracking/controller_settings.hpp"

#include "loop/settings.hpp"

namespace supercoil::config {

/// learned_ff with shape_reference, which follows closest by docs/control.md, behind a reference
/// model that is as quick as the muscle.
struct RecommendedController {
  double bandwidth_rad_per_s = 0.0;
  double pole_rad_per_s = 0.0;  ///< all three poles of the reference model
  std::string reason;           ///< for law and bandwidth
  std::string model_reason;

  /// The value of a [[channel]]'s `controller`.
  std::string literal() const;
  /// The value of its `reference_model`.
  std::string model_literal() const;
  /// The given controller with these values; everything else is kept.
  control::ControllerSettings applied_to(control::ControllerSettings controller) const;
  /// Whether it is the same law with at most 1.1 times that bandwidth.
  bool has_bandwidth_of(const control::ControllerSettings& controller) const;
  /// Whether law or shaping differ, or the bandwidth or a pole is more than a tenth off.
  bool differs_from(const control::ControllerSettings& controller) const;
};

/// Times of a board's loop: its tick, and loop_delay_s() of a channel.
struct LoopTime {
  double step_s = 1e-3;
  double delay_s = 1e-3;
};
/// With the margin that LoopTime leaves (docs/setup.md).
RecommendedController recommended_controller(const control::PhysicalParameters& muscle,
                                             const LoopTime& time = {});
/// Likewise, but keeps the bandwidth of the channel's first controller unless another one promises
/// a clearly smaller error.
RecommendedController recommended_controller(const ChannelSettings& channel,
                                             const BoardSettings& board);
/// Why the channel cannot use it, in words; empty: it can.
std::string problem_of(const RecommendedController& recommended, const ChannelSettings& channel,
                       double step_s);

}  // namespace supercoil::config
