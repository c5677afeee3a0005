// The CAN protocol as a table, for those who listen: generated from
// firmware/io/telemetry/supercoil.dbc.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

namespace supercoil::can_client {

struct ValueName {
  std::int64_t raw;
  std::string_view name;
};

/// What a signal's bits are; a floating one has 32 of IEEE 754.
enum class Raw : std::uint8_t { unsigned_integer, signed_integer, floating };

/// No raw value says "not available".
inline constexpr std::int64_t no_value = std::numeric_limits<std::int64_t>::min();
/// Not multiplexed.
inline constexpr int always = -1;

/// Little-endian, as all signals of the protocol are.
struct SignalInfo {
  std::string_view name;
  std::string_view unit;
  std::uint8_t start;   ///< its lowest bit in the frame
  std::uint8_t length;  ///< bits
  Raw raw;
  double scale;
  std::int64_t reserved;  ///< the raw value that says "not available"
  int selected_by;        ///< of the message's first signal: when this one is there
  std::span<const ValueName> names;
};

struct MessageInfo {
  std::string_view name;
  std::uint16_t base;  ///< identifier less node
  std::uint8_t length;
  std::span<const SignalInfo> signals;
};

/// In the order of identifiers.
std::span<const MessageInfo> protocol();

/// The message of this name; null: there is none.
const MessageInfo* find_message(std::string_view name);
/// A signal's place in its message; throws std::out_of_range for a name that the protocol lacks.
std::size_t signal_index(const MessageInfo& message, std::string_view name);
/// Name of a value; empty: it has none.
std::string_view value_name(const SignalInfo& signal, double value);

}  // namespace supercoil::can_client
