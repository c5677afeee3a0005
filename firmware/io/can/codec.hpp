// From values to frames and back, as the protocol's table defines it (supercoil.dbc).
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "supercoil/hal/can_bus.hpp"

#include "can/e2e.hpp"
#include "can/message.hpp"
#include "can/nodes.hpp"

namespace supercoil::can {

/// Puts a signal's value, in its unit, into a frame. A value outside of the signal's range becomes
/// the range's nearest end; NaN becomes "not available", or 0 where the signal has no such value.
void put(hal::CanFrame& frame, const SignalInfo& signal, double value);
/// NaN: not available.
double get(const hal::CanFrame& frame, const SignalInfo& signal);

/// A frame of one message; signals that are not set are 0.
template <const MessageInfo& message>
class Encoder {
 public:
  explicit Encoder(Node node) {
    frame_.id = id_of(message, node);
    frame_.length = message.length;
  }
  /// In the signal's unit; see put().
  Encoder& set(SignalOf<message> signal, double value) {
    put(frame_, signal.info(), value);
    return *this;
  }
  const hal::CanFrame& frame() const { return frame_; }
  hal::CanFrame& frame() { return frame_; }
  /// Adds the checksum. It also covers the session of a frame that has no room for it.
  template <class... Session>
  const hal::CanFrame& protected_frame(Session... session) {
    e2e::protect(frame_, session...);
    return frame_;
  }

 private:
  hal::CanFrame frame_;
};

/// Reads signals from a frame of this message.
template <const MessageInfo& message>
class Reader {
 public:
  explicit Reader(const hal::CanFrame& frame) : frame_(&frame) {}
  /// In the signal's unit; NaN: not available. Number: an integer only if it is always available.
  template <class Number = double>
  Number get(SignalOf<message> signal) const {
    return static_cast<Number>(can::get(*frame_, signal.info()));
  }

 private:
  const hal::CanFrame* frame_;
};

/// More than any message has; decode() checks it.
inline constexpr std::size_t max_signals = 20;

/// A frame whose message was not known beforehand.
struct Decoded {
  const MessageInfo* message;
  Node node;
  /// In the order of the message's signals, in their units. NaN: not available, or not in this
  /// frame.
  std::array<double, max_signals> values;
};

/// Decodes any message. Empty: the identifier or the length is not the protocol's.
std::optional<Decoded> decode(const hal::CanFrame& frame);

/// The message of this name; null: no such message.
const MessageInfo* find_message(std::string_view name);
/// A signal's index in its message; throws std::out_of_range for an unknown name.
std::size_t signal_index(const MessageInfo& message, std::string_view name);
/// Unit of the signals with this name; empty: no unit, or no such signal.
std::string_view unit_of(std::string_view signal_name);
/// Name of a value; empty: no name.
std::string_view value_name(const SignalInfo& signal, double value);

}  // namespace supercoil::can
