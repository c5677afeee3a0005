// From a frame to its signals' values.
#pragma once

#include <array>
#include <optional>

#include "supercoil/hal/can_bus.hpp"

#include "can_client/protocol.hpp"

namespace supercoil::can_client {

/// More than any message has; decode() checks it.
inline constexpr std::size_t most_signals = 20;

struct Decoded {
  const MessageInfo* message;
  std::uint8_t node;  ///< 1 to 63
  /// In the order of the message's signals, in their units. NaN: not available, or not in this
  /// frame.
  std::array<double, most_signals> values;
};

/// Empty: no frame of the protocol, for its identifier or its length.
std::optional<Decoded> decode(const hal::CanFrame& frame);

}  // namespace supercoil::can_client
