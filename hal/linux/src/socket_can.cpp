#include "supercoil/hal_linux/socket_can.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>

#include <linux/can.h>
#include <linux/can/error.h>
#include <sys/socket.h>

#include "supercoil/hal_linux/device_folder.hpp"
#include "supercoil/hal_linux/monotonic_clock.hpp"
#include "supercoil/hal_linux/status_of.hpp"

namespace supercoil::hal_linux {

namespace {

constexpr hal::Duration look_every = std::chrono::milliseconds(100);
/// A bus full of error frames must not hold up a caller that waits for a command.
constexpr int max_passed_over = 64;

/// Any packet of the socket.
struct Packet {
  hal::Status status = hal::Status::ok;
  std::size_t bytes = 0;
  can_frame frame{};
  hal::Time received{};
  bool from_this_machine = false;
};

/// The kernel's stamps are of CLOCK_REALTIME. A stamp in the future (that clock was set back
/// meanwhile) counts as now; a clock set forward makes a frame older, which is the safe side.
hal::Time received_at(const timespec& stamp) {
  timespec wall{};
  ::clock_gettime(CLOCK_REALTIME, &wall);
  const hal::Duration age = std::chrono::seconds(wall.tv_sec - stamp.tv_sec) +
                            std::chrono::nanoseconds(wall.tv_nsec - stamp.tv_nsec);
  return MonotonicClock::time() - std::max(age, hal::Duration{});
}

/// When the message arrived; now if the kernel does not say.
hal::Time time_of(msghdr& message) {
  for (cmsghdr* part = CMSG_FIRSTHDR(&message); part != nullptr;
       part = CMSG_NXTHDR(&message, part)) {
    if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SCM_TIMESTAMPNS) continue;
    timespec stamp{};
    std::memcpy(&stamp, CMSG_DATA(part), sizeof(stamp));
    return received_at(stamp);
  }
  return MonotonicClock::time();
}

Packet next_packet(const Descriptor& socket) {
  Packet packet;
  iovec place{&packet.frame, sizeof(packet.frame)};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(timespec))> control{};
  msghdr message{};
  message.msg_iov = &place;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  // MSG_TRUNC: the true length, so that a CAN FD frame is not taken for a classical one.
  const ssize_t got =
      uninterrupted([&] { return ::recvmsg(socket.number(), &message, MSG_DONTWAIT | MSG_TRUNC); });
  if (got < 0) {
    packet.status = status_of(errno);
    return packet;
  }
  packet.bytes = static_cast<std::size_t>(got);
  packet.received = time_of(message);
  packet.from_this_machine = (message.msg_flags & MSG_DONTROUTE) != 0;
  return packet;
}

/// The controller's state from an error frame; most do not report it.
hal::CanState state_after(const can_frame& error, hal::CanState before) {
  if ((error.can_id & CAN_ERR_BUSOFF) != 0) return hal::CanState::bus_off;
  if ((error.can_id & CAN_ERR_RESTARTED) != 0) return hal::CanState::active;
  if ((error.can_id & CAN_ERR_CRTL) == 0) return before;
  const unsigned detail = error.data[1];
  if ((detail & (CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE)) != 0) {
    return hal::CanState::error_passive;
  }
  constexpr unsigned better =
      CAN_ERR_CRTL_ACTIVE | CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING;
  return (detail & better) != 0 ? hal::CanState::active : before;
}

bool is_classical_data(const can_frame& frame) {
  return (frame.can_id & (CAN_EFF_FLAG | CAN_RTR_FLAG)) == 0 && frame.len <= CAN_MAX_DLEN;
}

}  // namespace

Result<std::unique_ptr<SocketCan>> SocketCan::open(const CanLocation& place) {
  auto link = open_can_interface(place);
  if (link) return std::make_unique<SocketCan>(place, std::move(*link));
  if (link.error().code != std::errc::no_such_device) return tl::unexpected(link.error());
  const std::vector<std::string> there = can_interfaces(place.net);
  return failure("no CAN interface '" + place.interface +
                 "': " + (there.empty() ? "there is none" : "there are " + listed(there)));
}

hal::Status SocketCan::send(const hal::CanFrame& frame) {
  if (frame.id > CAN_SFF_MASK || frame.length > CAN_MAX_DLEN) return hal::Status::out_of_range;
  if (!is_there()) return hal::Status::gone;
  can_frame raw{};
  raw.can_id = frame.id;
  raw.len = frame.length;
  std::copy_n(frame.data.begin(), frame.length, std::begin(raw.data));
  const auto sent = write_next(link_.socket, reinterpret_cast<const char*>(&raw), sizeof(raw));
  // The socket's own buffer is full, rather than the interface's queue (ENOBUFS).
  if (sent == hal::Status::not_ready) return hal::Status::busy;
  return lost_if_gone(sent);
}

hal::Status SocketCan::receive(hal::CanFrame& frame) {
  if (!is_there()) return hal::Status::gone;
  for (int i = 0; i < max_passed_over; ++i) {
    const Packet packet = next_packet(link_.socket);
    if (packet.status != hal::Status::ok) return lost_if_gone(packet.status);
    if (packet.bytes != sizeof(packet.frame)) continue;
    if ((packet.frame.can_id & CAN_ERR_FLAG) != 0) {
      link_.state = state_after(packet.frame, link_.state);
      continue;
    }
    // If the report of its restart was lost: a controller that receives is not bus-off.
    if (link_.state == hal::CanState::bus_off && !packet.from_this_machine) {
      link_.state = hal::CanState::active;
    }
    if (!is_classical_data(packet.frame)) continue;
    frame.id = static_cast<std::uint16_t>(packet.frame.can_id & CAN_SFF_MASK);
    frame.length = packet.frame.len;
    frame.data.fill(0);
    std::copy_n(std::begin(packet.frame.data), frame.length, frame.data.begin());
    frame.received = packet.received;
    return hal::Status::ok;
  }
  return hal::Status::not_ready;
}

bool SocketCan::is_there() {
  if (link_.socket.is_open()) return true;
  const hal::Time now = MonotonicClock::time();
  if (now < next_look_) return false;
  next_look_ = now + look_every;
  if (auto link = open_can_interface(place_)) link_ = std::move(*link);
  return link_.socket.is_open();
}

hal::Status SocketCan::lost_if_gone(hal::Status status) {
  if (status != hal::Status::gone) return status;
  // A socket of a vanished interface never hears a new interface with the same name.
  link_ = {};
  return status;
}

}  // namespace supercoil::hal_linux
