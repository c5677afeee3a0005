#include <algorithm>
#include <cmath>
#include <sstream>

#include "config/bus_time.hpp"
#include "config/read_wiring.hpp"

namespace supercoil::config {

namespace {

constexpr control::Names<BusKind, 2> bus_kind_names{{{"i2c", BusKind::i2c}, {"spi", BusKind::spi}}};

BusAddress read_bus(Section& section) {
  BusAddress bus;
  bus.name = section.required_text("name");
  const bool spi = bus.name.starts_with("spi");
  bus.kind = section.choice("kind", spi ? BusKind::spi : BusKind::i2c, bus_kind_names);
  // The default clock of I²C in Linux; a slow one for SPI.
  bus.clock_Hz = section.number("clock_Hz", bus.kind == BusKind::i2c ? 100e3 : 1e6, {10e3, 100e6});
  bus.overhead_s = 1e-6 * section.number("overhead_us", 1e6 * bus.overhead_s, {0.0, 10000.0});
  section.finish();
  return bus;
}

}  // namespace

std::vector<BusAddress> read_buses(std::vector<Section> sections) {
  std::vector<BusAddress> buses;
  for (Section& section : sections) {
    const BusAddress bus = read_bus(section);
    const auto same = [&](const BusAddress& other) { return other.name == bus.name; };
    if (!bus.name.empty() && std::any_of(buses.begin(), buses.end(), same)) {
      section.wrong("name", "is the name of another [[bus]]");
    }
    buses.push_back(bus);
  }
  return buses;
}

void refuse_slow_buses(std::vector<Section> sections, const BoardWiring& wiring, double step_s) {
  for (std::size_t i = 0; i < wiring.buses.size(); ++i) {
    const BusTime time = bus_time(wiring, wiring.buses[i]);
    if (!(time.total_s > max_bus_load * step_s)) continue;
    std::ostringstream message;
    message << "the bus would be busy for " << std::round(1e5 * time.total_s) / 100.0 << " ms of a "
            << "tick of " << 1e3 * step_s << " ms (" << std::lround(100.0 * time.total_s / step_s)
            << " %); the limit is " << 100.0 * max_bus_load << " %";
    sections[i].wrong("name", message.str());
  }
}

}  // namespace supercoil::config
