#include "config/describe.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "config/bus_time.hpp"
#include "loop/loop.hpp"
#include "recorder/flight_recorder.hpp"
#include "telemetry/schedule.hpp"
#include "text/number_text.hpp"

namespace supercoil::config {

namespace {

/// Rounds times and fractions for people.
double rounded(double value, double to) {
  return std::nearbyint(value / to) * to;
}

std::string shown(const board::AirSettings& air, const BoardWiring& wiring) {
  std::ostringstream out;
  out << air.coldest_C << " to " << air.warmest_C << " °C, ";
  if (wiring.air) {
    out << "measured to " << air.error_K << " K at " << shown(*wiring.air);
  } else {
    out << "not measured: warmer air makes the muscle hotter than the board assumes";
  }
  return out.str();
}

void describe_board(std::ostream& out, const BoardConfig& config) {
  const BoardSettings& s = config.settings;
  const BoardWiring& w = config.wiring;
  const BoardSupervision& v = s.supervision;
  const board::AirSettings& air = s.channels.front().thermal.air;
  out << "heartbeat      " << shown(w.heartbeat) << "; when it stops, the charge pump opens the "
      << "supply within " << 1e3 * v.charge_pump_decay_s << " ms\n"
      << "stop circuit   " << shown(w.stop_circuit) << "\n"
      << "light          " << (w.light ? shown(*w.light) : "none") << "\n";
  out << "watchdog       ";
  if (w.watchdog) {
    out << w.watchdog->device << ", resets the board after " << w.watchdog->timeout_s << " s\n";
  } else {
    out << "none\n";
  }
  out << "supply         " << shown(w.supply) << "\n               " << v.min_supply_V << " to "
      << v.max_supply_V << " V; outside for " << 1e3 * v.supply_s << " ms is a fault\n"
      << "air            " << shown(air, w) << "\n"
      << "commands       to heat expire after "
      << 1e3 * s.channels.front().supervision.command_timeout_s << " ms\n"
      << "lateness       " << v.overruns_in_a_row << " overruns in a row are a fault, and "
      << v.late_in_a_row << " ticks in a row that wake more than " << 1e3 * v.late_s << " ms late\n"
      << "storage folder " << config.storage_folder << "\n";
}

void describe_buses(std::ostream& out, const BoardConfig& config) {
  const double tick_s = config.settings.step_s();
  out << "\nbus time per tick of " << 1e3 * tick_s << " ms (at most " << 100.0 * max_bus_load
      << " %)\n";
  if (config.wiring.buses.empty()) out << "  no bus: every device is direct\n";
  for (const BusAddress& bus : config.wiring.buses) {
    const BusTime time = bus_time(config.wiring, bus);
    out << "  " << bus.name << ": " << rounded(1e3 * time.total_s, 1e-3) << " ms, "
        << rounded(100.0 * time.total_s / tick_s, 0.1) << " %, at " << 1e-3 * bus.clock_Hz
        << " kHz\n";
    for (const BusUser& user : time.users)
      out << "    " << user.what << " " << rounded(1e3 * user.time_s, 1e-3) << " ms\n";
  }
}

void describe_can(std::ostream& out, const BoardConfig& config) {
  out << "\nCAN";
  if (!config.can) {
    out << ": none\n";
    return;
  }
  const telemetry::CanSettings& can = *config.can;
  const std::vector<ChannelSettings>& channels = config.settings.channels;
  const bool has_joint = std::ranges::any_of(
      channels, [](const ChannelSettings& channel) { return channel.joint.turns(); });
  const double load = telemetry::bus_load(can, channels);
  out << " on " << can.interface << " at " << 1e-3 * can.bit_rate << " kbit/s, nodes "
      << int{can.first_node} << " to " << can.first_node + channels.size() - 1 << "\n  load    "
      << rounded(100.0 * load, 0.1) << " % at worst, without commands (at most "
      << rounded(100.0 * can.max_load, 0.1) << " %)\n  lease   " << 1e3 * can.lease_s
      << " ms without use\n";
  for (std::size_t i = 0; i < telemetry::messages; ++i) {
    const telemetry::PeriodicMessage& message = telemetry::periodic_messages()[i];
    const bool of_joint = i == static_cast<std::size_t>(telemetry::Message::joint);
    if (of_joint && !has_joint) continue;
    out << "  " << message.name << " " << can.rates_Hz[i] << " Hz"
        << (message.of_board ? ", of the board" : "") << (of_joint ? ", of each joint\n" : "\n");
  }
}

void describe_memory(std::ostream& out, const BoardSettings& settings) {
  const Memory memory = memory_of(settings);
  const auto kib = [](std::size_t bytes) { return (bytes + 1023) / 1024; };
  const recorder::RecorderSettings recorder;
  out << "\nmemory, excluding program and stacks\n"
      << "  recorder " << kib(memory.recorder)
      << " KiB: " << recorder.before_s + recorder.after_s + recorder.retry_s << " s of ticks, "
      << sizeof(Row) << " bytes per channel and tick\n"
      << "  ring     " << kib(memory.ring) << " KiB: " << row_ring_s << " s of rows\n"
      << "  loop     " << kib(memory.loop) << " KiB, " << settings.channels.size()
      << (settings.channels.size() == 1 ? " channel" : " channels") << " in it\n"
      << "  total    " << kib(memory.total()) << " KiB\n";
}

}  // namespace

std::string shown(const LineAddress& line) {
  return line.line + " of " + line.chip;
}

std::string shown(const ConverterAddress& converter) {
  std::string access = ", direct";
  if (converter.access.buffered()) access = ", buffered on " + converter.access.bus;
  if (converter.capture) access = ", captured at " + converter.capture->trigger;
  return converter.input + " of " + converter.device + access;
}

Memory memory_of(const BoardSettings& settings) {
  const recorder::RecorderSettings recorder;
  const double rows_per_s = settings.rate_Hz * static_cast<double>(settings.channels.size());
  const auto bytes = [&](double time_s) {
    return static_cast<std::size_t>(time_s * rows_per_s) * sizeof(Row);
  };
  Memory memory;
  memory.ring = bytes(row_ring_s);
  memory.recorder = bytes(recorder.before_s + recorder.after_s + recorder.retry_s);
  memory.loop = sizeof(Loop);
  for (const ChannelSettings& channel : settings.channels) {
    memory.loop += sizeof(Channel) + sizeof(ChannelSettings) +
                   channel.controllers.size() * sizeof(control::Controller) +
                   channel.estimators.size() * sizeof(control::Estimator) +
                   (channel.thermal.weighed() ? sizeof(control::CoolingFit) : 0);
  }
  return memory;
}

std::string describe_bundle(const BoardConfig& config, std::size_t index) {
  const auto& channels = config.settings.bundles[index].channels;
  double max_W = std::numeric_limits<double>::infinity();
  for (const std::size_t channel : channels)
    max_W = std::min(max_W, config.settings.channels[channel].limiter.max_W);
  std::ostringstream out;
  out << "bundle " << index + 1 << ": " << config.bundles[index] << "\n  muscles     channels ";
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (i > 0) out << (i + 1 < channels.size() ? ", " : " and ");
    out << channels[i] + 1;
  }
  out << " pull together; commands go to channel " << channels.front() + 1
      << "\n  power       the same for each, at most " << number_text(max_W, 4)
      << " W: " << number_text(max_W * static_cast<double>(channels.size()), 4) << " W together\n";
  return out.str();
}

std::string describe(const BoardConfig& config) {
  std::ostringstream out;
  const std::size_t channels = config.settings.channels.size();
  out << config.name << ": " << channels << (channels == 1 ? " channel" : " channels") << " at "
      << config.settings.rate_Hz << " Hz\n\n";
  describe_board(out, config);
  for (std::size_t i = 0; i < channels; ++i)
    out << "\n" << describe_channel(config, i);
  for (std::size_t i = 0; i < config.settings.joints.size(); ++i)
    out << "\n" << describe_joint(config, i);
  for (std::size_t i = 0; i < config.settings.bundles.size(); ++i)
    out << "\n" << describe_bundle(config, i);
  describe_buses(out, config);
  describe_can(out, config);
  const auto weak = warnings(config);
  out << "\ndetectors that cannot work, or work poorly" << (weak.empty() ? ": none\n" : "\n");
  for (const std::string& line : weak)
    out << "  " << line << "\n";
  const auto advised = advice(config);
  if (!advised.empty()) out << "\nadvice\n";
  for (const std::string& line : advised)
    out << "  " << line << "\n";
  describe_memory(out, config.settings);
  return out.str();
}

}  // namespace supercoil::config
