#include "operator/doctor/check_board.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "supercoil/hal_linux/check/can_link.hpp"
#include "supercoil/hal_linux/check/kernel.hpp"
#include "supercoil/hal_linux/check/rights.hpp"
#include "supercoil/hal_linux/check/rivals.hpp"
#include "supercoil/hal_linux/check/watchdog.hpp"

#include "linux_board/lock_file.hpp"
#include "operator/doctor/check_buses.hpp"
#include "operator/doctor/check_devices.hpp"
#include "telemetry/schedule.hpp"

namespace supercoil::doctor {

namespace {

using hal::Verdict;

void check_system(const CheckOptions& options, const hal::Tell& tell) {
  check_kernel(options.machine, tell);
  check_throttling(options.machine, tell);
  check_priority(options.machine, options.loop, tell);
  check_rivals(options.machine, options.loop, tell);
  check_locked_memory(options.machine, tell);
  check_wakefulness(options.machine, tell);
  check_governor(options.machine, tell);
  check_processors(options.machine, options.loop, tell);
}

std::string in_percent(double part) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f %%", 100.0 * part);
  return text.data();
}

/// The interface that is asked for, or that of the configuration; and what the board will send.
void check_can(const config::BoardConfig& config, const CheckOptions& options,
               const hal::Tell& tell) {
  const auto& can = config.can;
  const std::string interface = can && options.can.empty() ? can->interface : options.can;
  if (!interface.empty()) check_can_link(options.machine, interface, tell);
  if (!can) return;
  const double load = telemetry::bus_load(*can, config.settings.channels.size());
  tell({"CAN load", Verdict::ok,
        in_percent(load) + " of " + std::to_string(std::lround(1e-3 * can->bit_rate)) +
            " kbit/s at worst, beside commands; at most " + in_percent(can->most_load),
        ""});
}

}  // namespace

void check_board(const config::BoardConfig& config, const CheckOptions& options,
                 const hal::Tell& tell) {
  check_system(options, tell);
  check_can(config, options, tell);
  const auto lock = linux_board::LockFile::take(options.run_folder + "/lock");
  const auto& watchdog = config.wiring.watchdog;
  if (watchdog) {
    check_watchdog(options.machine, watchdog->device, !lock.has_value(), tell);
  } else {
    tell({"watchdog", Verdict::warning, "none: board.watchdog is absent",
          "use one: without it a kernel that hangs is never reset"});
  }
  BusTimes measured;
  if (lock) {
    measured = check_devices(config, options.machine, options.loop.priority, tell);
  } else {
    tell({"devices", Verdict::warning, "not looked at: " + lock.error(),
          "stop supercoild, or make its folder, and run this again"});
  }
  check_buses(config, measured, tell);
}

}  // namespace supercoil::doctor
