// How a user names a bus: can0, socketcand:29536, socketcand:192.168.0.7:29536/can0.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "supercoil/hal/can_bus.hpp"
#include "supercoil/hal/error.hpp"

namespace supercoil::operating {

struct SocketcandAddress {
  std::string host = "127.0.0.1";
  std::uint16_t port = 29536;
  std::string interface = "can0";
};

/// "socketcand:[HOST:]PORT[/INTERFACE]". The error says what is wrong with the name.
Result<SocketcandAddress> parse_socketcand(const std::string& name);
bool is_socketcand_name(const std::string& name);

/// listen: wanted identifiers; empty: all. Others may arrive too. The error names the bus, and
/// says what is available instead.
Result<std::unique_ptr<hal::CanBus>> open_bus(const std::string& name,
                                              const std::vector<std::uint16_t>& listen = {});

}  // namespace supercoil::operating
