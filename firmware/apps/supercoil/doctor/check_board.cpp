#include "apps/supercoil/doctor/check_board.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "supercoil/hal_linux/checks.hpp"

#include "apps/supercoil/doctor/check_devices.hpp"
#include "linux_board/lock_file.hpp"
#include "storage/posix_files.hpp"
#include "storage/store.hpp"
#include "telemetry/schedule.hpp"
#include "text/documentation.hpp"
#include "text/nearest.hpp"

namespace supercoil::doctor {

namespace {

using hal::Severity;

void check_system(const CheckOptions& options, const hal::FindingSink& sink) {
  check_kernel(options.machine, sink);
  check_throttling(options.machine, sink);
  check_priority(options.machine, options.loop, sink);
  check_competing_threads(options.machine, options.loop, sink);
  check_locked_memory(options.machine, sink);
  check_cpu_latency(options.machine, sink);
  check_governor(options.machine, sink);
  check_processors(options.machine, options.loop, sink);
}

std::string in_percent(double part) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f %%", 100.0 * part);
  return text.data();
}

/// Checks the requested interface, or the configured one, and what the board will send.
void check_can(const config::BoardConfig& config, const CheckOptions& options,
               const hal::FindingSink& sink) {
  const auto& can = config.can;
  const std::string interface = can && options.can.empty() ? can->interface : options.can;
  if (!interface.empty()) check_can_interface(options.machine, interface, sink);
  if (!can) return;
  const double load = telemetry::bus_load(*can, config.settings.channels);
  sink({"CAN load", Severity::ok,
        in_percent(load) + " of " + std::to_string(std::lround(1e-3 * can->bit_rate)) +
            " kbit/s at worst, without commands; the limit is " + in_percent(can->max_load),
        ""});
}

/// What each channel has learned, as supercoild loads it at its start.
void check_storage(const config::BoardConfig& config, const hal::FindingSink& sink) {
  storage::PosixFiles files;
  std::string versions;
  std::vector<std::string> damaged;
  for (std::size_t i = 0; i < config.settings.channels.size(); ++i) {
    const int channel = static_cast<int>(i + 1);
    const auto loaded = storage::LearnedStore(config.storage_folder, channel, files).load();
    if (!loaded) {
      return sink(
          {"storage", Severity::problem, loaded.error().text(),
           "create the folder, mount its disk, or correct board.storage_folder; if a file is "
           "damaged, restore a copy, or move the channel's files away and identify again"});
    }
    damaged.insert(damaged.end(), loaded->problems.begin(), loaded->problems.end());
    versions += std::string(i > 0 ? ", " : "") + "channel " + std::to_string(channel) + " " +
                (loaded->learned ? "version " + std::to_string(loaded->learned->version)
                                 : std::string("nothing"));
  }
  if (!damaged.empty()) {
    return sink({"storage", Severity::warning, joined(damaged),
                 "copy the folder away, and replace the card or disk if it damages files"});
  }
  sink({"storage", Severity::ok, config.storage_folder + ": learned by " + versions, ""});
}

/// Lists the devices of one kind by their kernel names.
void list_devices(const std::string& what, const std::string& folder, const std::string& prefix,
                  const std::string& remedy, const hal::FindingSink& sink) {
  std::vector<std::string> names;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    std::string name = entry.path().filename().string();
    if (name.starts_with(prefix)) names.push_back(std::move(name));
  }
  std::sort(names.begin(), names.end());
  if (names.empty()) return sink({what, Severity::warning, "none in " + folder, remedy});
  sink({what, Severity::ok, joined(names), ""});
}

}  // namespace

void check_machine(const CheckOptions& options, const hal::FindingSink& sink) {
  check_system(options, sink);
  if (!options.can.empty()) check_can_interface(options.machine, options.can, sink);
  const hal_linux::Machine& m = options.machine;
  list_devices("GPIO chips", m.dev, "gpiochip", "load the driver of this board's GPIO", sink);
  list_devices("PWM chips", m.pwm_chips(), "pwmchip",
               "enable PWM, or an expander such as the PCA9685, in the device tree", sink);
  list_devices("I2C buses", m.sys + "/bus/i2c/devices", "i2c-",
               "enable I2C in the device tree, if a device is on it", sink);
  list_devices("SPI devices", m.sys + "/bus/spi/devices", "spi",
               "enable SPI in the device tree, if a device is on it", sink);
  list_devices(
      "CAN interfaces", m.sys + "/class/net", "can",
      "bring one up (see " + documentation_page("can") + "), if this board is to be on a bus",
      sink);
  list_devices("converters", m.converters(), "iio:device",
               "enable the converter in the device tree", sink);
}

void check_board(const config::BoardConfig& config, const CheckOptions& options,
                 const hal::FindingSink& sink) {
  check_system(options, sink);
  check_can(config, options, sink);
  check_storage(config, sink);
  const auto lock = linux_board::LockFile::take(options.run_folder + "/lock");
  const auto& watchdog = config.wiring.watchdog;
  if (watchdog) {
    check_watchdog(options.machine, watchdog->device, !lock.has_value(), sink);
  } else {
    sink({"watchdog", Severity::warning, "none: board.watchdog is absent",
          "configure one: without it a kernel that hangs is never reset"});
  }
  BusTimes measured;
  if (lock) {
    measured = check_devices(config, options.machine, options.loop.priority, sink);
  } else {
    sink({"devices", Severity::warning, "not checked: " + lock.error().text(),
          "stop supercoild, or create its folder, and run this again"});
  }
  check_buses(config, measured, sink);
}

}  // namespace supercoil::doctor
