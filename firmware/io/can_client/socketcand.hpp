// Text of both sides of the socketcand protocol: elements "< word word >" over TCP.
// https://github.com/linux-can/socketcand/blob/master/doc/protocol.md
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "supercoil/hal/can_bus.hpp"

namespace supercoil::can_client {

/// Splits a stream of bytes into elements. Ignores bytes outside of elements, and elements longer
/// than any of the protocol's.
class ElementReader {
 public:
  /// The next bytes of the stream, split anywhere.
  void put(std::string_view bytes);
  /// The text between < and >, trimmed of spaces; empty: the next element is not complete yet.
  std::optional<std::string> take();

 private:
  std::string text_;
  bool inside_ = false;
};

/// "< send 123 2 AA 0 >", and back from an element of ElementReader. Empty: another element, or not
/// a classical frame with an 11-bit identifier.
std::string send_text(const hal::CanFrame& frame);
/// element: as ElementReader gives it. Empty: as said of send_text().
std::optional<hal::CanFrame> parse_send(std::string_view element);

/// "< frame 123 23.424242 AA00 >". at: since 1970, or since the server's own start of time.
std::string frame_text(const hal::CanFrame& frame, hal::Time at);
/// Inverts frame_text(), with `at` as the frame's `received`. Empty: as for parse_send().
std::optional<hal::CanFrame> parse_frame(std::string_view element);

}  // namespace supercoil::can_client
