#include "config/bus_time.hpp"

namespace supercoil::config {

double transaction_s(const BusAddress& bus, int bytes) {
  // I²C: each byte has its acknowledge; start and stop take about a bit each.
  const int bits = bus.kind == BusKind::i2c ? 9 * bytes + 2 : 8 * bytes;
  return bits / bus.clock_Hz + bus.overhead_s;
}

BusTime bus_time(const BoardWiring& wiring, const BusAddress& bus) {
  BusTime result;
  const auto add = [&](const Access& access, const std::string& what) {
    if (access.bus != bus.name) return;
    const double time_s = access.transactions * transaction_s(bus, access.bytes) + access.wait_s;
    result.users.push_back({what, time_s});
    result.total_s += time_s;
  };
  add(wiring.supply.access, "supply");
  if (wiring.air) add(wiring.air->access, "air");
  int number = 0;
  for (const ChannelWiring& channel : wiring.channels) {
    const std::string name = "channel " + std::to_string(++number);
    add(channel.pwm.access, name + " PWM");
    if (!channel.position_of) add(channel.position.access, name + " position");
    add(channel.current.access, name + " current");
  }
  return result;
}

}  // namespace supercoil::config
