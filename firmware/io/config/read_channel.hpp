// One [[channel]], with what [every_channel] says laid under it.
#pragma once

#include <optional>
#include <vector>

#include "config/board_config.hpp"
#include "config/read_wiring.hpp"

namespace supercoil::config {

/// What a channel is read with and checked against.
struct BoardContext {
  const BoardSettings& board;  ///< complete but for its channels
  WiringReader& wiring;
  board::AirSettings air;
  double command_timeout_s;
  int damaged_in_a_row;
  int refused_in_a_row;
  bool joint_is_wrong;  ///< what a channel lacks may come from it: position, max_travel_m
};

struct ReadChannel {
  ChannelSettings settings;
  ChannelWiring wiring;
  ChannelLabel label;
};

/// The agonist of the channel's joint, as it was read.
struct ReadAgonist {
  std::size_t index;  ///< from 0
  const ChannelSettings& settings;
  const ChannelWiring& wiring;
  const ChannelLabel& label;
};

/// What is known of the channel from its joint before it is read.
struct ReadJoint {
  PlaceInJoint place;
  std::optional<double> max_travel_m;  ///< by its range_deg; empty: by the channel's own limits
  std::optional<ReadAgonist> agonist;  ///< empty for every channel but an antagonist
};

/// number: from 1, as messages call it.
ReadChannel read_channel(Section section, int number, const BoardContext& context,
                         const ReadJoint& joint);

// Its tables; each finishes its section.

/// [channel.muscle] and [channel.thermal]. After the limits.
void read_muscle(Section muscle, Section thermal, const BoardContext& context, ChannelSettings& c);
/// [channel.limits]: power, temperature, travel, energy. After heater and position.
/// joint_travel_m: by range_deg of its joint.
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
