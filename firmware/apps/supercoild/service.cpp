#include "apps/supercoild/service.hpp"

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include <sys/socket.h>
#include <sys/un.h>

#include "supercoil/hal_linux/descriptor.hpp"

namespace supercoil::daemon {

namespace {

std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string_view() : value;
}

}  // namespace

Service::Service() : socket_(variable("NOTIFY_SOCKET")) {
  const std::string_view text = variable("WATCHDOG_USEC");
  std::int64_t interval_us = 0;
  std::from_chars(text.data(), text.data() + text.size(), interval_us);
  alive_every_ = std::chrono::microseconds(interval_us / 2);
}

void Service::notify(std::string_view state) const {
  sockaddr_un address{};
  if (socket_.empty() || socket_.size() >= sizeof(address.sun_path)) return;
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, socket_.data(), socket_.size());
  if (socket_.front() == '@') address.sun_path[0] = '\0';  // abstract socket
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + socket_.size());
  const hal_linux::Descriptor socket(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!socket.is_open()) return;
  static_cast<void>(::sendto(socket.number(), state.data(), state.size(), MSG_NOSIGNAL,
                             reinterpret_cast<const sockaddr*>(&address), length));
}

void Service::alive(hal::Time now) {
  if (alive_every_ == hal::Duration{} || now < next_) return;
  next_ = now + alive_every_;
  notify("WATCHDOG=1");
}

}  // namespace supercoil::daemon
