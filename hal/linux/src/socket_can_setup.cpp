#include <algorithm>
#include <cerrno>

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <linux/if.h>
#include <linux/if_arp.h>
#include <sys/socket.h>

#include "supercoil/hal_linux/attribute.hpp"
#include "supercoil/hal_linux/device_folder.hpp"
#include "supercoil/hal_linux/socket_can.hpp"

namespace supercoil::hal_linux {

namespace {

/// The errors that report the controller's state.
constexpr can_err_mask_t reported_errors = CAN_ERR_CRTL | CAN_ERR_BUSOFF | CAN_ERR_RESTARTED;

/// A value of an interface, as the kernel reports it.
Result<std::int64_t> interface_value(const std::string& net, const std::string& interface,
                                     const char* what) {
  return read_integer(net + "/" + interface + "/" + what);
}

Result<void> check(const CanLocation& place) {
  const std::string& name = place.interface;
  if (name.empty() || name.size() >= IFNAMSIZ || name.find('/') != std::string::npos) {
    return failure("'" + name + "' is not a network interface name");
  }
  if (place.listen.size() > CAN_RAW_FILTER_MAX) {
    return failure(name + ": listens to " + std::to_string(place.listen.size()) +
                   " identifiers; the maximum is 512");
  }
  for (const std::uint16_t id : place.listen) {
    if (id > CAN_SFF_MASK) {
      return failure(name + ": " + std::to_string(id) + " is not an 11-bit identifier (0 to 2047)");
    }
  }
  return {};
}

Result<void> set_option(const Descriptor& socket, int level, int option, const void* value,
                        std::size_t size, const std::string& what) {
  const auto length = static_cast<socklen_t>(size);
  if (::setsockopt(socket.number(), level, option, value, length) == 0) return {};
  return failed_call("cannot set up a CAN socket: " + what, errno);
}

/// Set before the socket is bound, so that only listed frames are received from the start.
Result<void> set_filters(const Descriptor& socket, const CanLocation& place) {
  std::vector<can_filter> filters;
  filters.reserve(place.listen.size() + 1);
  if (place.listen_to_all) filters.push_back({0, CAN_EFF_FLAG | CAN_RTR_FLAG});
  for (const std::uint16_t id : place.listen)
    filters.push_back({id, CAN_EFF_FLAG | CAN_RTR_FLAG | CAN_SFF_MASK});
  return set_option(socket, SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(),
                    filters.size() * sizeof(can_filter), "receive filters");
}

Result<void> set_options(const Descriptor& socket, const CanLocation& place) {
  const int on = 1;
  return set_filters(socket, place)
      .and_then([&] {
        return set_option(socket, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &reported_errors,
                          sizeof(reported_errors), "error frames");
      })
      .and_then([&] {
        return set_option(socket, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof(on), "timestamps");
      });
}

Result<Descriptor> open_socket(const CanLocation& place, int index) {
  Descriptor socket(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
  if (!socket.is_open()) {
    return failed_call("no CAN sockets (kernel modules can, can-raw)", errno);
  }
  if (auto set = set_options(socket, place); !set) return tl::unexpected(set.error());
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = index;
  if (::bind(socket.number(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
    return failed_call("cannot bind a CAN socket to " + place.interface, errno);
  }
  return socket;
}

}  // namespace

Result<CanInterface> open_can_interface(const CanLocation& place) {
  if (auto checked = check(place); !checked) return tl::unexpected(checked.error());
  const auto type = interface_value(place.net, place.interface, "type");
  const auto index = interface_value(place.net, place.interface, "ifindex");
  if (!type || !index || *type != ARPHRD_CAN) {
    return failed_call("no CAN interface '" + place.interface + "'", ENODEV);
  }
  // Not readable while the interface is down. A controller loses its carrier only by bus-off.
  const auto carrier = interface_value(place.net, place.interface, "carrier");
  if (!carrier) return CanInterface{};
  auto socket = open_socket(place, static_cast<int>(*index));
  if (!socket) return tl::unexpected(socket.error());
  return CanInterface{std::move(*socket),
                      *carrier == 0 ? hal::CanState::bus_off : hal::CanState::active};
}

std::vector<std::string> can_interfaces(const std::string& net) {
  std::vector<std::string> found;
  for (const std::string& name : names_in(net).value_or(std::vector<std::string>{})) {
    if (interface_value(net, name, "type").value_or(0) == ARPHRD_CAN) found.push_back(name);
  }
  return found;
}

}  // namespace supercoil::hal_linux
