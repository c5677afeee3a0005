// What a tracking law multiplies its signals by: its settings, or what it has adapted them to.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

namespace supercoil::control {

/// The numbers go over CAN.
enum class Gain : std::uint8_t {
  none = 0,
  proportional = 1,  ///< W/m
  integral = 2,      ///< W/(m s)
  derivative = 3,    ///< W s/m
  feedforward = 4,   ///< of the model's position, W/m
  // θ of MRAC, Eq. (16): of ω's six signals in turn. Power and position are in watts at rest.
  power_rate = 5,     ///< of s u/λ
  power = 6,          ///< of u/λ
  position_rate = 7,  ///< of s y/λ
  position_lag = 8,   ///< of y/λ
  position = 9,       ///< of y
  reference = 10,     ///< of r: c0
  sigma = 11,         ///< σ of Eq. (16)
  // Of the model's motion, beside `feedforward`.
  feedforward_velocity = 12,      ///< W s/m
  feedforward_acceleration = 13,  ///< W s²/m
  feedforward_jerk = 14,          ///< W s³/m
  bias = 15,                      ///< W
};

inline constexpr std::array<std::string_view, 16> gain_names{"none",
                                                             "proportional",
                                                             "integral",
                                                             "derivative",
                                                             "feedforward",
                                                             "power_rate",
                                                             "power",
                                                             "position_rate",
                                                             "position_lag",
                                                             "position",
                                                             "reference",
                                                             "sigma",
                                                             "feedforward_velocity",
                                                             "feedforward_acceleration",
                                                             "feedforward_jerk",
                                                             "bias"};
/// As recordings and CAN clients write it.
constexpr std::string_view name(Gain gain) {
  return gain_names[static_cast<std::size_t>(gain)];
}

/// One of a law's gains as it is now.
struct GainValue {
  Gain gain = Gain::none;
  double value = std::numeric_limits<double>::quiet_NaN();  ///< in the gain's unit
};

}  // namespace supercoil::control
