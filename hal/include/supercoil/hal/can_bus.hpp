// A CAN controller.
#pragma once

#include <array>
#include <cstdint>

#include "supercoil/hal/clock.hpp"
#include "supercoil/hal/status.hpp"

namespace supercoil::hal {

/// A classical frame with an 11-bit identifier.
struct CanFrame {
  std::uint16_t id = 0;     ///< 0 to 0x7FF
  std::uint8_t length = 0;  ///< 0 to 8
  std::array<std::uint8_t, 8> data{};
  Time received{};
};

/// The bus state that the controller reports.
enum class CanState { active, error_passive, bus_off, down };

/// Owned by the telemetry thread; never used in a tick. Nothing blocks: send() hands over or
/// answers busy (a full queue: ENOBUFS), receive() answers not_ready when no frame has arrived.
class CanBus {
 public:
  CanBus() = default;
  CanBus(const CanBus&) = delete;
  CanBus& operator=(const CanBus&) = delete;
  virtual ~CanBus() = default;

  /// Hands a frame over for sending. ok does not mean that it was on the bus.
  virtual Status send(const CanFrame& frame) = 0;
  /// The oldest frame that waits. frame is valid only with ok.
  virtual Status receive(CanFrame& frame) = 0;
  /// The last known state.
  virtual CanState state() const = 0;
};

}  // namespace supercoil::hal
