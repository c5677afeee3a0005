// The text of the socketcand protocol, both sides of it: elements "< word word >" over TCP.
// https://github.com/linux-can/socketcand/blob/master/doc/protocol.md
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "supercoil/hal/can_bus.hpp"

namespace supercoil::can_client {

/// Cuts a stream of bytes into its elements. What stands outside of them is passed over, and so is
/// an element that is longer than any of the protocol's.
class ElementReader {
 public:
  void put(std::string_view bytes);
  /// What stands between < and >, without spaces at its ends; empty: the next is not whole yet.
  std::optional<std::string> take();

 private:
  std::string text_;
  bool inside_ = false;
};

/// "< send 123 2 AA 0 >", and back from what ElementReader gives of it. Empty: no such element, or
/// no classical frame with an 11-bit identifier.
std::string send_text(const hal::CanFrame& frame);
std::optional<hal::CanFrame> parse_send(std::string_view element);

/// "< frame 123 23.424242 AA00 >". at: since 1970, or since whenever the server counts.
std::string frame_text(const hal::CanFrame& frame, hal::Time at);
std::optional<hal::CanFrame> parse_frame(std::string_view element);

}  // namespace supercoil::can_client
