#include "apps/supercoil/doctor/check_board.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "supercoil/hal_linux/check/can_link.hpp"
#include "supercoil/hal_linux/check/kernel.hpp"
#include "supercoil/hal_linux/check/rights.hpp"
#include "supercoil/hal_linux/check/rivals.hpp"
#include "supercoil/hal_linux/check/watchdog.hpp"

#include "apps/supercoil/doctor/check_buses.hpp"
#include "apps/supercoil/doctor/check_devices.hpp"
#include "linux_board/lock_file.hpp"
#include "telemetry/schedule.hpp"
#include "text/nearest.hpp"

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

/// What there is of a kind, by the names that the kernel gives it.
void list_devices(const std::string& what, const std::string& folder, const std::string& prefix,
                  const std::string& remedy, const hal::Tell& tell) {
  std::vector<std::string> names;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    std::string name = entry.path().filename().string();
    if (name.starts_with(prefix)) names.push_back(std::move(name));
  }
  std::sort(names.begin(), names.end());
  if (names.empty()) return tell({what, Verdict::warning, "none in " + folder, remedy});
  tell({what, Verdict::ok, joined(names), ""});
}

}  // namespace

void check_machine(const CheckOptions& options, const hal::Tell& tell) {
  check_system(options, tell);
  if (!options.can.empty()) check_can_link(options.machine, options.can, tell);
  const hal_linux::Machine& m = options.machine;
  list_devices("GPIO chips", m.dev, "gpiochip", "load the driver of this board's GPIO", tell);
  list_devices("PWM chips", m.pwm_chips(), "pwmchip",
               "enable PWM, or an expander such as the PCA9685, in the device tree", tell);
  list_devices("I2C buses", m.sys + "/bus/i2c/devices", "i2c-",
               "enable I2C in the device tree, if a device is on it", tell);
  list_devices("SPI devices", m.sys + "/bus/spi/devices", "spi",
               "enable SPI in the device tree, if a device is on it", tell);
  list_devices("CAN interfaces", m.sys + "/class/net", "can",
               "bring one up (docs/can.md), if this board is to be on a bus", tell);
  list_devices("converters", m.converters(), "iio:device",
               "enable the converter in the device tree", tell);
}

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
