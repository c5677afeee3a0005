// How a user names a bus: can0, socketcand:29536, socketcand:192.168.0.7:29536/can0.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "supercoil/hal/can_bus.hpp"

namespace supercoil::operating {

struct SocketcandAddress {
  std::string host = "127.0.0.1";
  std::uint16_t port = 29536;
  std::string interface = "can0";
};

/// "socketcand:[HOST:]PORT[/INTERFACE]". The error says what is wrong with the name.
tl::expected<SocketcandAddress, std::string> parse_socketcand(const std::string& name);
bool names_socketcand(const std::string& name);

/// listen: identifiers that are wanted; none: all. Others may come too. The error names the bus,
/// and says what there is instead.
tl::expected<std::unique_ptr<hal::CanBus>, std::string> open_bus(
    const std::string& name, const std::vector<std::uint16_t>& listen = {});

}  // namespace supercoil::operating
