// The names that states, modes and limits have in CSV files and summaries.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "loop/snapshot.hpp"

namespace supercoil::recorder {

/// A number that this program has no name for (a newer firmware's, or damage) is shown as it is.
template <std::size_t N>
std::string named(const std::array<std::string_view, N>& names, std::uint8_t number) {
  return number < N ? std::string(names[number]) : std::to_string(number);
}

inline std::string state_name(std::uint8_t number) {
  return named(state_names, number);
}
inline std::string mode_name(std::uint8_t number) {
  return named(mode_names, number);
}
inline std::string result_name(std::uint8_t number) {
  return named(mode_result_names, number);
}
inline std::string limit_name(std::uint8_t number) {
  return named(limit_names, number);
}
inline std::string gain_name(std::uint8_t number) {
  return named(control::gain_names, number);
}
inline std::string multiplexed_name(std::uint8_t number) {
  return named(multiplexed_names, number);
}
inline std::string fault_name(std::uint8_t number) {
  if (number == 0) return "none";
  const auto known = info(static_cast<Fault>(number));
  return known ? std::string(known->name) : std::to_string(number);
}

}  // namespace supercoil::recorder
