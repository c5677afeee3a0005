// A board with one joint, turned by two different muscles.
#pragma once

#include <string>

#include "unit/firmware/io/config/support/small_board.hpp"

namespace supercoil::test {

/// Its position is that of the first channel.
inline const std::string second_channel = R"([[channel]]
enable = {line = "EN2"}
pwm = {device = "pwm", number = 1}
[channel.current]
device = "adc"
input = "voltage3"
A_per_count = 0.0001
[channel.heater]
cold_resistance_Ohm = 10.0
[channel.muscle]
heat_transfer_W_per_K = 0.0712
[channel.thermal]
min_mass_J_per_K = 0.13
max_mass_J_per_K = 0.20
min_transfer_W_per_K = 0.045
max_transfer_W_per_K = 0.18
[channel.limits]
max_W = 4.0
max_travel_m = 0.02
)";
inline const std::string one_joint =
    "[[joint]]\nname = 'elbow'\nagonist = 1\nantagonist = 2\nlever_m = 0.015\n";
inline const std::string board_with_joint =
    small_board_with("min_m = -0.001", "min_m = -0.041") + second_channel + one_joint;

}  // namespace supercoil::test
