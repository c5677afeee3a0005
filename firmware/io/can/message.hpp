// What the CAN protocol's messages and signals are made of; generated/messages.hpp has them all.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

namespace supercoil::can {

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
  std::uint8_t length;  ///< bits, 1 to 48
  Raw raw;
  double scale;
  std::int64_t reserved;  ///< the raw value that says "not available", at one end of the range
  int selected_by;        ///< of the message's first signal: when this one is there
  std::span<const ValueName> names;
};

/// In which every value of the signal can be written and read back. A scaled one in 15, which show
/// nothing of the product's rounding; nine are all that a float has.
constexpr int significant_digits(const SignalInfo& signal) {
  return signal.raw == Raw::floating ? 9 : 15;
}

struct MessageInfo {
  std::string_view name;
  std::uint16_t base;   ///< identifier less node
  std::uint8_t length;  ///< bytes
  unsigned period_ms;   ///< between two of them, usually; 0: sent when there is a reason
  std::span<const SignalInfo> signals;
};

/// The place of a message's signal. Looked up when the program is compiled: a name that the message
/// lacks does not build.
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
