// One [[channel]], with what [every_channel] says laid under it.
#pragma once

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
  bool joint_is_wrong;  ///< and which channels have no position of their own is not known
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
};

/// number: from 1, as messages call it. agonist: null for every channel but an antagonist.
ReadChannel read_channel(Section section, int number, const BoardContext& context,
                         const PlaceInJoint& joint, const ReadAgonist* agonist);

// Its tables; each finishes its section.

/// [channel.muscle] and [channel.thermal]. After the limits.
void read_muscle(Section muscle, Section thermal, const BoardContext& context, ChannelSettings& c);
/// [channel.limits]: power, temperature, travel, energy. After heater and position.
void read_limits(Section section, const BoardContext& context, ChannelSettings& c,
                 ChannelLabel& label);
/// [channel.heater]. After the current.
void read_heater(Section section, const BoardContext& context, const PwmAddress& pwm,
                 ChannelSettings& c, ChannelLabel& label);
/// [channel.detectors]. After everything else but control.
void read_detectors(Section section, const BoardContext& context, const ChannelWiring& wiring,
                    ChannelSettings& c);
/// [channel.bundle]; empty: there is none. After the detectors.
std::optional<Bundle> read_bundle(Section section, const ChannelSettings& c);

}  // namespace supercoil::config
