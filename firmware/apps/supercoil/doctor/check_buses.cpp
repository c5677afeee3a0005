#include <array>
#include <cstdio>

#include "apps/supercoil/doctor/check_devices.hpp"
#include "config/bus_time.hpp"

namespace supercoil::doctor {

namespace {

/// Measured times vary with the board's other load.
constexpr double max_excess_ratio = 1.25;

std::string tick_text(double time_s, double tick_s) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.3f ms (%.1f %% of a tick)", 1e3 * time_s,
                100.0 * time_s / tick_s);
  return text.data();
}

}  // namespace

void check_buses(const config::BoardConfig& config, const BusTimes& measured,
                 const hal::FindingSink& sink) {
  using hal::Severity;
  const double tick_s = config.settings.step_s();
  for (const config::BusAddress& bus : config.wiring.buses) {
    const std::string what = "bus " + bus.name;
    const double computed_s = config::bus_time(config.wiring, bus).total_s;
    const std::string computed = tick_text(computed_s, tick_s) + " by the configuration";
    const auto found = measured.find(bus.name);
    if (found == measured.end()) {
      sink({what, Severity::ok, computed + "; not measured", ""});
      continue;
    }
    const double time_s = hal::seconds(found->second);
    const std::string both = computed + ", " + tick_text(time_s, tick_s) + " measured";
    if (time_s > config::max_bus_load * tick_s) {
      sink({what, Severity::problem, both + ": the limit is 70 %",
            "a faster clock, fewer devices on this bus, or a lower rate_Hz"});
    } else if (time_s > max_excess_ratio * computed_s) {
      sink({what, Severity::warning, both,
            "correct clock_Hz, overhead_us, transactions or wait_ms: the check of the bus's time "
            "relies on them"});
    } else {
      sink({what, Severity::ok, both, ""});
    }
  }
}

}  // namespace supercoil::doctor
