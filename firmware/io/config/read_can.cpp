#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <vector>

#include "config/read_board.hpp"
#include "telemetry/schedule.hpp"

namespace supercoil::config {

namespace {

/// The kernel's IFNAMSIZ, less the zero at the end.
constexpr std::size_t max_interface = 15;

telemetry::Rates read_rates(Section section, double tick_Hz) {
  telemetry::Rates rates = telemetry::default_rates();
  for (std::size_t i = 0; i < telemetry::messages; ++i) {
    const std::string key = std::string(telemetry::periodic_messages()[i].name) + "_Hz";
    const auto message = static_cast<telemetry::Message>(i);
    const double min_Hz = message == telemetry::Message::status ? telemetry::min_status_Hz : 0.0;
    rates[i] = section.number(key, rates[i], {min_Hz, telemetry::max_rate(tick_Hz)});
    if (!telemetry::is_allowed(message, rates[i], tick_Hz)) {
      std::ostringstream range;
      range << "must be 0, for never, or at least " << telemetry::min_rate_Hz;
      section.wrong(key, range.str());
    }
  }
  section.finish();
  return rates;
}

void refuse_load(Section& section, const telemetry::CanSettings& can,
                 const std::vector<ChannelSettings>& channels) {
  const double load = telemetry::bus_load(can, channels);
  if (!(load > can.max_load)) return;
  std::ostringstream message;
  message << "the bus would be busy for " << std::lround(100.0 * load)
          << " % by messages sent at a rate; the limit is " << std::lround(100.0 * can.max_load)
          << " % (max_load): choose lower rates";
  section.wrong("bit_rate", message.str());
}

}  // namespace

telemetry::CanSettings read_can(Section section, double tick_Hz,
                                const std::vector<ChannelSettings>& channels) {
  telemetry::CanSettings can;
  can.interface = section.text("interface", can.interface);
  if (can.interface.empty() || can.interface.size() > max_interface) {
    section.wrong("interface", "must be a name of 1 to 15 characters");
  }
  can.bit_rate = static_cast<double>(
      section.integer("bit_rate", std::lround(can.bit_rate), 10'000, 1'000'000));
  const auto last_first = can::max_nodes + 1 - static_cast<std::int64_t>(channels.size());
  can.first_node = static_cast<can::Node>(
      section.integer("first_node", can.first_node, 1, std::max<std::int64_t>(last_first, 1)));
  can.max_load = section.number("max_load", can.max_load, {0.01, 0.9});
  can.lease_s = 1e-3 * section.number("lease_ms", 1e3 * can.lease_s, {100.0, 60e3});
  can.rates_Hz = read_rates(section.section("rates"), tick_Hz);
  refuse_load(section, can, channels);
  section.finish();
  return can;
}

}  // namespace supercoil::config
