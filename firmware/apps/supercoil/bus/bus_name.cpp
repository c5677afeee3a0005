#include "apps/supercoil/bus/bus_name.hpp"

#include "supercoil/hal_linux/socket_can.hpp"

#include "apps/supercoil/bus/socketcand_bus.hpp"
#include "can_client/text.hpp"

namespace supercoil::operating {

namespace {

constexpr std::string_view protocol = "socketcand:";

}  // namespace

bool is_socketcand_name(const std::string& name) {
  return name.starts_with(protocol);
}

Result<SocketcandAddress> parse_socketcand(const std::string& name) {
  const auto wrong = [&] {
    return failure("'" + name +
                   "': must be socketcand:[HOST:]PORT[/INTERFACE], a port from 1 to 65535");
  };
  SocketcandAddress address;
  std::string rest = name.substr(std::min(protocol.size(), name.size()));
  if (const std::size_t slash = rest.find('/'); slash != std::string::npos) {
    address.interface = rest.substr(slash + 1);
    rest.resize(slash);
  }
  if (const std::size_t colon = rest.rfind(':'); colon != std::string::npos) {
    address.host = rest.substr(0, colon);
    rest.erase(0, colon + 1);
  }
  const auto port = can_client::number<std::uint16_t>(rest, 10);
  // The interface must not contain anything that ends the protocol's brackets.
  const bool plain = address.interface.find_first_of(" <>/") == std::string::npos;
  if (!port || *port == 0 || address.host.empty() || address.interface.empty() || !plain)
    return wrong();
  address.port = *port;
  return address;
}

Result<std::unique_ptr<hal::CanBus>> open_bus(const std::string& name,
                                              const std::vector<std::uint16_t>& listen) {
  if (is_socketcand_name(name)) {
    const auto address = parse_socketcand(name);
    if (!address) return tl::unexpected(address.error());
    auto bus = SocketcandBus::open(*address);
    if (!bus) return failure(name + ": " + bus.error().text());
    return std::move(*bus);
  }
  auto bus = hal_linux::SocketCan::open({name, listen, "/sys/class/net", listen.empty()});
  if (!bus) return failure(bus.error().text() + "; for a simulated board use socketcand:PORT");
  return std::move(*bus);
}

}  // namespace supercoil::operating
