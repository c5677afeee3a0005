// One [[channel]], with [every_channel] laid under it.
#pragma once

#include <optional>
#include <vector>

#include "config/board_config.hpp"
#include "config/read_wiring.hpp"

namespace supercoil::config {

/// What a channel is read with and checked against.
struct BoardContext {
  const BoardSettings& board;  ///< complete except for its channels
  WiringReader& wiring;
  board::AirSettings air;
  double command_timeout_s;
  int damaged_in_a_row;
  int refused_in_a_row;
  // A wrong joint or bundle may be why a channel lacks:
  bool joint_is_wrong;   ///< position, max_travel_m
  bool bundle_is_wrong;  ///< position
};

/// A channel as its table describes it.
struct ReadChannel {
  ChannelSettings settings;
  ChannelWiring wiring;
  ChannelLabel label;
};

/// The channel with the position sensor of this one's joint or bundle, as it was read.
struct PositionOwner {
  std::size_t index;  ///< from 0
  const ChannelSettings& settings;
  const ChannelWiring& wiring;
  const ChannelLabel& label;
};

/// What is known of the channel from its joint or bundle before it is read.
struct ReadGroup {
  PlaceInJoint joint;
  std::optional<double> max_travel_m;  ///< from range_deg; empty: from the channel's own limits
  std::optional<PositionOwner> position_owner;  ///< empty: it has a sensor of its own
};

/// number: from 1, as in messages.
ReadChannel read_channel(Section section, int number, const BoardContext& context,
                         const ReadGroup& group);

// Its tables; each finishes its section.

/// [channel.muscle] and [channel.thermal]. After the limits.
void read_muscle(Section muscle, Section thermal, const BoardContext& context, ChannelSettings& c);
/// [channel.limits]: power, temperature, travel, energy. After heater and position.
/// joint_travel_m: from range_deg of its joint.
void read_limits(Section section, const BoardContext& context, ChannelSettings& c,
                 ChannelLabel& label, const std::optional<double>& joint_travel_m);
/// [channel.heater]. After the current.
void read_heater(Section section, const BoardContext& context, const PwmAddress& pwm,
                 ChannelSettings& c, ChannelLabel& label);
/// [channel.detectors]. After everything else but control.
void read_detectors(Section section, const BoardContext& context, const ChannelWiring& wiring,
                    ChannelSettings& c);
/// [channel.bundle]; empty: there is none. After the detectors.
std::optional<Bundle> read_bundle(Section section, const ChannelSettings& c);

}  // namespace supercoil::config
