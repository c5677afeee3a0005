// Numbers, times and bytes as candump and socketcand write them.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "supercoil/hal/can_bus.hpp"

#include "text/words.hpp"

namespace supercoil::can_client {

inline constexpr std::size_t digits_of_standard_id = 3;
inline constexpr std::uint32_t standard_ids = 0x800;

/// The whole text as an integer; empty: not an integer, or too large.
template <class Number>
std::optional<Number> number(std::string_view text, int base) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// With leading zeros.
template <unsigned Base>
void add_number(std::string& text, std::uint64_t number, std::size_t digits) {
  constexpr std::string_view all_digits = "0123456789ABCDEF";
  const std::size_t at = text.size();
  text.append(digits, '0');
  for (std::size_t i = digits; i-- > 0; number /= Base)
    text[at + i] = all_digits[number % Base];
}

/// "SECONDS.MICROSECONDS"; a time before 0 becomes 0.
inline void add_time(std::string& text, hal::Time time) {
  constexpr std::uint64_t second_us = 1'000'000;
  const auto time_us = static_cast<std::uint64_t>(std::max<std::int64_t>(0, time.count() / 1000));
  add_number<10>(text, time_us / second_us, 10);
  text += '.';
  add_number<10>(text, time_us % second_us, 6);
}
/// Any number of digits after the point; digits below nanoseconds are cut off.
std::optional<hal::Time> parse_time(std::string_view text);

/// Two digits per byte.
inline void add_bytes(std::string& text, const hal::CanFrame& frame) {
  for (std::size_t i = 0; i < frame.length; ++i)
    add_number<16>(text, frame.data.at(i), 2);
}
/// False: not pairs of hexadecimal digits, or more than 8 pairs.
bool parse_bytes(std::string_view text, hal::CanFrame& frame);

}  // namespace supercoil::can_client
