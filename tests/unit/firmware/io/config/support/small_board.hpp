// The smallest valid board, and what is read when a part of its text is replaced.
#pragma once

#include <string>

#include "config/board_config.hpp"

namespace supercoil::test {

inline const std::string small_board = R"([board]
charge_pump_decay_ms = 20
[lines]
chip = "gpio"
heartbeat = {line = "BEAT"}
stop_circuit = {line = "STOP"}
[ambient]
coldest_C = 15
warmest_C = 30
[[bus]]
name = "i2c-1"
clock_Hz = 400000
[supply]
device = "adc"
input = "voltage0"
V_per_count = 0.001
min_V = 10.8
max_V = 13.2
[[channel]]
enable = {line = "EN1"}
pwm = {device = "pwm", number = 0}
[channel.position]
device = "adc"
input = "voltage1"
m_per_count = 1e-6
min_m = -0.001
max_m = 0.041
[channel.current]
device = "adc"
input = "voltage2"
A_per_count = 0.0001
[channel.heater]
cold_resistance_Ohm = 10.0
[channel.thermal]
min_mass_J_per_K = 0.13
max_mass_J_per_K = 0.20
min_transfer_W_per_K = 0.045
max_transfer_W_per_K = 0.18
[channel.limits]
max_W = 4.5
max_travel_m = 0.025
)";

/// The text with the first occurrence of `old` replaced.
inline std::string replaced(std::string text, const std::string& old,
                            const std::string& replacement) {
  const std::size_t at = text.find(old);
  return at == std::string::npos ? "no such text: " + old
                                 : text.replace(at, old.size(), replacement);
}
inline std::string small_board_with(const std::string& old, const std::string& replacement) {
  return replaced(small_board, old, replacement);
}

/// All problems of the text, one per line; empty when it is valid.
inline std::string problems_of(const std::string& text) {
  const auto config = config::parse_board_config(text, "b.toml");
  return config ? "" : config::to_text(config.error());
}

}  // namespace supercoil::test
