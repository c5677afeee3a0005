// A CAN controller through the kernel's raw sockets (SocketCAN).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "supercoil/hal/can_bus.hpp"
#include "supercoil/hal/error.hpp"
#include "supercoil/hal_linux/descriptor.hpp"

namespace supercoil::hal_linux {

/// Which bus, and which frames are received. Bit rate and restart after bus-off are the interface's
/// set-up ("ip link set can0 up type can bitrate 500000 restart-ms 100"), not the firmware's.
struct CanLocation {
  std::string interface;              ///< e.g. can0
  std::vector<std::uint16_t> listen;  ///< identifiers, 0 to 0x7FF, at most 512; none: hears nothing
  std::string net = "/sys/class/net";
  bool listen_to_all = false;  ///< regardless of `listen`
};

/// An interface as it was found: without a socket when it is down.
struct CanInterface {
  Descriptor socket;
  hal::CanState state = hal::CanState::down;
};

/// A socket that receives what `place` listens to and the controller's error frames, each with its
/// time of arrival. The error for a missing interface carries its errno.
Result<CanInterface> open_can_interface(const CanLocation& place);

/// Every CAN interface of this machine, up or not.
std::vector<std::string> can_interfaces(const std::string& net);

/// Used by one thread. An interface that goes down or vanishes is `down`, and everything answers
/// gone; send() and receive() then check every 100 ms whether it is back, and resume. That check
/// may wait for another program that is configuring the network; nothing else waits.
class SocketCan final : public hal::CanBus {
 public:
  /// An interface that is down is not an error: it may come up later. One that is missing or is not
  /// CAN is an error that lists the CAN interfaces.
  static Result<std::unique_ptr<SocketCan>> open(const CanLocation& place);
  SocketCan(CanLocation place, CanInterface link)
      : place_(std::move(place)), link_(std::move(link)) {}

  /// busy: the kernel's queue is full, and the frame is not in it. out_of_range: not a valid frame.
  hal::Status send(const hal::CanFrame& frame) override;
  /// Skips all but classical data frames with 11-bit identifiers. CanFrame::received is when the
  /// kernel received it, so the age of a frame includes its time in the queue.
  hal::Status receive(hal::CanFrame& frame) override;
  /// From the last error frame, so receive() has to be called. A controller that was error-passive
  /// before this was opened counts as active until it reports.
  hal::CanState state() const override { return link_.state; }

 private:
  bool is_there();
  hal::Status lost_if_gone(hal::Status status);

  CanLocation place_;
  CanInterface link_;
  hal::Time next_look_{};
};

}  // namespace supercoil::hal_linux
