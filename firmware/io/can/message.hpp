// The structure of CAN messages and signals; generated/messages.hpp lists them all.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

namespace supercoil::can {

/// The name of one raw value of a signal.
struct ValueName {
  std::int64_t raw;
  std::string_view name;
};

/// How a signal's bits are read; a floating one has the 32 bits of IEEE 754.
enum class Raw : std::uint8_t { unsigned_integer, signed_integer, floating };

/// The signal has no raw value for "not available".
inline constexpr std::int64_t no_value = std::numeric_limits<std::int64_t>::min();
/// Not multiplexed.
inline constexpr int always = -1;

/// Little-endian, as all signals of the protocol are.
struct SignalInfo {
  std::string_view name;
  std::string_view unit;
  std::uint8_t start;   ///< its lowest bit in the frame
  std::uint8_t length;  ///< bits, 1 to 48
  Raw raw;
  double scale;
  std::int64_t reserved;  ///< the raw value for "not available", at one end of the range
  int selected_by;        ///< value of the message's first signal with which this one is present
  std::span<const ValueName> names;
};

/// Digits with which every value of the signal reads back the same: 9 for a float; 15 for a scaled
/// value, so that the rounding of the product does not show.
constexpr int significant_digits(const SignalInfo& signal) {
  return signal.raw == Raw::floating ? 9 : 15;
}

/// A message as the DBC has it, for every node that sends or receives it.
struct MessageInfo {
  std::string_view name;
  std::uint16_t base;   ///< identifier less node
  std::uint8_t length;  ///< bytes
  unsigned period_ms;   ///< usual period; 0: sent when there is a reason
  std::span<const SignalInfo> signals;
  bool to_node;  ///< sent by a master: it does not prove that its node exists
};

/// A signal of a message, looked up at compile time: an unknown name does not build.
template <const MessageInfo& message>
class SignalOf {
 public:
  consteval SignalOf(const char* name) : info_(find(name)) {}
  constexpr const SignalInfo& info() const { return *info_; }

 private:
  static consteval const SignalInfo* find(std::string_view name) {
    for (const SignalInfo& signal : message.signals) {
      if (signal.name == name) return &signal;
    }
    throw "the message has no such signal";
  }

  const SignalInfo* info_;
};

}  // namespace supercoil::can
