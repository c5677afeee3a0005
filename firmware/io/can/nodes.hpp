// Which identifier belongs to which node and channel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "supercoil/hal/can_bus.hpp"

#include "can/message.hpp"

namespace supercoil::can {

/// 1 to 63: one channel of a board. The nodes of a board are consecutive.
using Node = std::uint8_t;
inline constexpr int max_nodes = 63;

/// The identifier of this message from or to this node.
constexpr std::uint16_t id_of(const MessageInfo& message, Node node) {
  return static_cast<std::uint16_t>(message.base + node);
}

/// The channel that the frame addresses, on a board with this many channels. Empty: another board's
/// frame, or another message.
inline std::optional<std::uint8_t> channel_of(const hal::CanFrame& frame,
                                              const MessageInfo& message, Node first_node,
                                              std::size_t channels) {
  const int channel = frame.id - id_of(message, first_node);
  if (channel < 0 || channel >= static_cast<int>(channels)) return std::nullopt;
  return static_cast<std::uint8_t>(channel);
}

}  // namespace supercoil::can
