// The gains by which a tracking law multiplies its signals, as set or as adapted.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

namespace supercoil::control {

/// The numbers are sent over CAN.
enum class Gain : std::uint8_t {
  none = 0,
  proportional = 1,  ///< W/m
  integral = 2,      ///< W/(m s)
  derivative = 3,    ///< W s/m
  feedforward = 4,   ///< of the model's position, W/m
  // θ of MRAC, Eq. (16): for ω's six signals in order. Power and position are in watts at rest.
  power_rate = 5,     ///< of s u/λ
  power = 6,          ///< of u/λ
  position_rate = 7,  ///< of s y/λ
  position_lag = 8,   ///< of y/λ
  position = 9,       ///< of y
  reference = 10,     ///< of r: c0
  sigma = 11,         ///< σ of Eq. (16)
  // For the model's motion, in addition to `feedforward`.
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

/// The present value of one of a law's gains.
struct GainValue {
  Gain gain = Gain::none;
  double value = std::numeric_limits<double>::quiet_NaN();  ///< in the gain's unit
};

}  // namespace supercoil::control
