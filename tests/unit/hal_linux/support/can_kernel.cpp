#include "unit/hal_linux/support/can_kernel.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include <linux/can/raw.h>
#include <sys/socket.h>
#include <unistd.h>

namespace supercoil::test {

namespace {
CanKernel* current = nullptr;

int refuse(int error) {
  errno = error;
  return -1;
}
}  // namespace

CanKernel::CanKernel() {
  current = this;
}

CanKernel::~CanKernel() {
  current = nullptr;
  if (peer_ >= 0) ::close(peer_);
}

void CanKernel::plug(const std::string& name, int index, int type) const {
  net.write(name + "/type", std::to_string(type) + "\n");
  net.write(name + "/ifindex", std::to_string(index) + "\n");
  set_up(name);
}

void CanKernel::set_up(const std::string& name) const {
  net.write(name + "/carrier", "1\n");
}

void CanKernel::lose_carrier(const std::string& name) const {
  net.write(name + "/carrier", "0\n");
}

void CanKernel::set_down(const std::string& name) {
  // The kernel still shows the file, but it cannot be read.
  net.remove(name + "/carrier");
  receive_errors.push_back(ENETDOWN);
}

void CanKernel::unplug(const std::string& name) {
  net.remove(name + "/type");
  receive_errors.push_back(ENODEV);
}

void CanKernel::deliver(const void* packet, std::size_t bytes) const {
  static_cast<void>(::send(peer_, packet, bytes, MSG_DONTWAIT) < 0);
}

void CanKernel::deliver(std::uint32_t id, std::initializer_list<std::uint8_t> data) const {
  can_frame frame{};
  frame.can_id = id;
  frame.len = static_cast<std::uint8_t>(data.size());
  std::copy(data.begin(), data.end(), std::begin(frame.data));
  deliver(&frame, sizeof(frame));
}

std::optional<can_frame> CanKernel::sent() const {
  can_frame frame{};
  if (::recv(peer_, &frame, sizeof(frame), MSG_DONTWAIT) != sizeof(frame)) return std::nullopt;
  return frame;
}

// NOLINTBEGIN(bugprone-reserved-identifier): the linker's names
extern "C" {
ssize_t __real_recvmsg(int file, msghdr* message, int flags);
int __real_setsockopt(int file, int level, int option, const void* value, socklen_t size);

int __wrap_socket(int family, int type, int protocol) {
  if (current->socket_error != 0) return refuse(current->socket_error);
  if (family != PF_CAN || (type & SOCK_RAW) == 0 || protocol != CAN_RAW) return refuse(EINVAL);
  std::array<int, 2> ends{};
  const int kind = SOCK_DGRAM | (type & (SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (::socketpair(AF_UNIX, kind, 0, ends.data()) != 0) return -1;
  current->take_peer(ends[1]);
  return ends[0];
}
int __wrap_setsockopt(int file, int level, int option, const void* value, socklen_t size) {
  if (current->option_error != 0) return refuse(current->option_error);
  if (level != SOL_CAN_RAW) return __real_setsockopt(file, level, option, value, size);
  if (option == CAN_RAW_FILTER) {
    const auto* const filters = static_cast<const can_filter*>(value);
    current->filters.assign(filters, filters + size / sizeof(can_filter));
  } else if (option == CAN_RAW_ERR_FILTER) {
    std::memcpy(&current->reported_errors, value, sizeof(current->reported_errors));
  } else {
    return refuse(ENOPROTOOPT);
  }
  return 0;
}
int __wrap_bind(int, const sockaddr* address, socklen_t size) {
  sockaddr_can can{};
  if (size != sizeof(can)) return refuse(EINVAL);
  std::memcpy(&can, address, sizeof(can));
  if (can.can_family != AF_CAN) return refuse(EINVAL);
  current->bound_to = can.can_ifindex;
  return 0;
}
ssize_t __wrap_recvmsg(int file, msghdr* message, int flags) {
  if (!current->receive_errors.empty()) {
    const int error = current->receive_errors.front();
    current->receive_errors.pop_front();
    return refuse(error);
  }
  if (current->flood > 0) {
    --current->flood;
    const can_frame remote{CAN_RTR_FLAG | 0x201, {}, 0, 0, 0, {}};
    std::memcpy(message->msg_iov->iov_base, &remote, sizeof(remote));
    return sizeof(remote);
  }
  const ssize_t got = __real_recvmsg(file, message, flags);
  if (current->from_this_machine) message->msg_flags |= MSG_DONTROUTE;
  return got;
}
}
// NOLINTEND(bugprone-reserved-identifier)

void CanKernel::take_peer(int file) {
  if (peer_ >= 0) ::close(peer_);
  peer_ = file;
  ++sockets;
}

}  // namespace supercoil::test
