// A CAN controller by the kernel's raw sockets (SocketCAN).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "supercoil/hal/can_bus.hpp"
#include "supercoil/hal/error.hpp"
#include "supercoil/hal_linux/descriptor.hpp"

namespace supercoil::hal_linux {

/// Which bus, and what is heard of it. Bit rate and restart after bus-off are the interface's
/// set-up ("ip link set can0 up type can bitrate 500000 restart-ms 100"), not the firmware's.
struct CanLocation {
  std::string interface;              ///< e.g. can0
  std::vector<std::uint16_t> listen;  ///< identifiers, 0 to 0x7FF, at most 512; none: hears nothing
  std::string net = "/sys/class/net";
  bool listen_to_all = false;  ///< whatever is listed
};

/// An interface as it was found: without a socket when it is down.
struct CanInterface {
  Descriptor socket;
  hal::CanState state = hal::CanState::down;
};

/// A socket that hears what is listened to and the controller's error frames, with the time when
/// each came. The error has the errno of an interface that is not there.
Result<CanInterface> open_can_interface(const CanLocation& place);

/// Every CAN interface of this machine, up or not.
std::vector<std::string> can_interfaces(const std::string& net);

/// Used by one thread. An interface that goes down or vanishes is `down`, and everything answers
/// gone; send() and receive() then look every 100 ms whether it is back, and go on with it. That
/// look may wait for another program that configures the network at this moment; else nothing
/// waits.
class SocketCan final : public hal::CanBus {
 public:
  /// An interface that is down is not an error: it may come up later. One that is not there, or is
  /// none of CAN, is an error that says which there are.
  static Result<std::unique_ptr<SocketCan>> open(const CanLocation& place);
  SocketCan(CanLocation place, CanInterface link)
      : place_(std::move(place)), link_(std::move(link)) {}

  /// busy: the kernel's queue is full, and the frame is not in it. out_of_range: no such frame.
  hal::Status send(const hal::CanFrame& frame) override;
  /// Skips all but classical data frames with 11-bit identifiers. CanFrame::received is when the
  /// kernel got it, so a frame that waited is as old as it is.
  hal::Status receive(hal::CanFrame& frame) override;
  /// As the last error frame told: so receive() has to be called. A controller that was
  /// error-passive before this was opened is taken as active until it tells.
  hal::CanState state() const override { return link_.state; }

 private:
  bool is_there();
  hal::Status lost_if_gone(hal::Status status);

  CanLocation place_;
  CanInterface link_;
  hal::Time next_look_{};
};

}  // namespace supercoil::hal_linux
