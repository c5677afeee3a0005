// What a board does on its CAN bus.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "loop/settings.hpp"
#include "telemetry/frames.hpp"

namespace supercoil::telemetry {

/// The rate of each message in Hz, for each channel, in the order of Message; 0: never.
using Rates = std::array<double, messages>;
/// By the period that each message has in the DBC.
Rates default_rates();

/// A slower heartbeat would be none; a lower rate of another message is meant as never.
inline constexpr double min_status_Hz = 1.0;
inline constexpr double min_rate_Hz = 0.01;
/// No message is sent more often than there is new data.
constexpr double max_rate(double tick_Hz) {
  return tick_Hz < 1000.0 ? tick_Hz : 1000.0;
}
/// How often each node reports which program it runs (Boot); too little load for a setting.
inline constexpr hal::Duration boot_period = std::chrono::seconds(1);
/// Whether the rate is between min and max, or 0 for never, which a heartbeat must not be.
bool is_allowed(Message message, double rate_Hz, double tick_Hz);
/// Whether this channel's node (from 0) sends it; a board's messages come from its first node only.
inline bool is_of(std::size_t channel, Message message) {
  return channel == 0 || !periodic_messages()[static_cast<std::size_t>(message)].of_board;
}

/// [can] of a board's configuration.
struct CanSettings {
  std::string interface = "can0";
  double bit_rate = 500e3;   ///< bit/s
  can::Node first_node = 1;  ///< the first channel's; the others follow
  Rates rates_Hz = default_rates();
  double max_load = 0.5;   ///< of the bus, for periodic messages: the rest is for commands
  double lease_s = 1.0;    ///< a master that is silent for this long loses its lease
  std::size_t queue = 64;  ///< max number of frames that wait for the bus
};

/// The rates of each channel's node; the rate of Joint is 0 unless it is the node of a joint.
std::vector<Rates> rates_of(const CanSettings& can, const std::vector<ChannelSettings>& channels);

}  // namespace supercoil::telemetry
