// What a board does on its CAN bus.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "telemetry/frames.hpp"

namespace supercoil::telemetry {

/// Of each message for each channel, in Hz, in the order of Message; 0: never.
using Rates = std::array<double, messages>;
Rates usual_rates();

struct CanSettings {
  std::string interface = "can0";
  double bit_rate = 500e3;  ///< bit/s
  Node first_node = 1;      ///< the first channel's; the others follow
  Rates rates_Hz = usual_rates();
  double most_load = 0.5;  ///< of the bus, by what is sent at a rate: the rest is for commands
  double lease_s = 1.0;    ///< a master that is silent for so long loses its lease
  std::size_t queue = 64;  ///< frames that wait for the bus at most
};

}  // namespace supercoil::telemetry
