#include "can_client/text.hpp"

#include <limits>

namespace supercoil::can_client {

std::optional<hal::Time> parse_time(std::string_view text) {
  const std::size_t point = text.find('.');
  if (point == std::string_view::npos || point + 1 == text.size()) return std::nullopt;
  std::string fraction(text.substr(point + 1));
  constexpr std::size_t digits_of_nanoseconds = 9;
  fraction.resize(digits_of_nanoseconds, '0');
  // 64 bits of nanoseconds reach twice as far.
  constexpr std::uint64_t max_s = std::numeric_limits<std::uint32_t>::max();
  const auto seconds = number<std::uint64_t>(text.substr(0, point), 10);
  const auto rest = number<std::uint32_t>(fraction, 10);
  if (!seconds || !rest || *seconds > max_s) return std::nullopt;
  return hal::Time(std::chrono::seconds(*seconds) + std::chrono::nanoseconds(*rest));
}

bool parse_bytes(std::string_view text, hal::CanFrame& frame) {
  if (text.size() % 2 != 0 || text.size() > 2 * frame.data.size()) return false;
  for (std::size_t i = 0; i < text.size(); i += 2) {
    const auto byte = number<std::uint8_t>(text.substr(i, 2), 16);
    if (!byte) return false;
    frame.data.at(i / 2) = *byte;
  }
  frame.length = static_cast<std::uint8_t>(text.size() / 2);
  return true;
}

}  // namespace supercoil::can_client
