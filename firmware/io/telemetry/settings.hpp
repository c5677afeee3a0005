// What a board does on its CAN bus.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "loop/settings.hpp"
#include "telemetry/frames.hpp"

namespace supercoil::telemetry {

/// Of each message for each channel, in Hz, in the order of Message; 0: never.
using Rates = std::array<double, messages>;
Rates default_rates();

/// A heartbeat that is rarer is none; what is rarer than the other is meant to be never.
inline constexpr double min_status_Hz = 1.0;
inline constexpr double min_rate_Hz = 0.01;
/// No message more often than there is news.
constexpr double max_rate(double tick_Hz) {
  return tick_Hz < 1000.0 ? tick_Hz : 1000.0;
}
/// Each node tells so often which program it runs (Boot): no load that needs a setting.
inline constexpr hal::Duration boot_period = std::chrono::seconds(1);
/// Between the least and the most, or 0 for never, which a heartbeat may not be.
bool is_allowed(Message message, double rate_Hz, double tick_Hz);
/// Whether this channel's node (from 0) sends it; the board's first node sends what is the board's.
inline bool is_of(std::size_t channel, Message message) {
  return channel == 0 || !periodic_messages()[static_cast<std::size_t>(message)].of_board;
}

struct CanSettings {
  std::string interface = "can0";
  double bit_rate = 500e3;   ///< bit/s
  can::Node first_node = 1;  ///< the first channel's; the others follow
  Rates rates_Hz = default_rates();
  double max_load = 0.5;   ///< of the bus, by what is sent at a rate: the rest is for commands
  double lease_s = 1.0;    ///< a master that is silent for so long loses its lease
  std::size_t queue = 64;  ///< frames that wait for the bus at most
};

/// Of each channel's node: 0 of Joint where it is not the node of a joint.
std::vector<Rates> rates_of(const CanSettings& can, const std::vector<ChannelSettings>& channels);

}  // namespace supercoil::telemetry
