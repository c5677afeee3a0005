// The devices of a Linux board, as its configuration names them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "supercoil/hal/error.hpp"
#include "supercoil/hal_linux/bus_thread.hpp"
#include "supercoil/hal_linux/dev_watchdog.hpp"
#include "supercoil/hal_linux/gpio_line.hpp"
#include "supercoil/hal_linux/monotonic_clock.hpp"

#include "board/devices.hpp"
#include "config/wiring.hpp"

namespace supercoil::linux_board {

/// How a bus keeps up with the loop.
struct BusReport {
  std::string name;
  std::uint64_t left_out = 0;  ///< rounds skipped since the start, as earlier ones took too long
  double max_s = 0.0;          ///< of the longest round
};

/// After opening, everything is off: heartbeat still, enable lines low, duties 0. It is left so
/// when this ends.
class LinuxBoard {
 public:
  /// Opens lines, then PWM, then converters. The error has a line for each device that cannot be
  /// opened.
  static tl::expected<std::unique_ptr<LinuxBoard>, std::vector<std::string>> open(
      const config::BoardWiring& wiring);

  /// Starts a thread for each bus and, last, the watchdog, which is active from then on. Returns a
  /// warning, or nothing.
  Result<std::string> start(double rate_Hz, int priority);
  /// Stops the watchdog. Call it when the loop has stopped and everything is off. Returns a
  /// warning, or nothing.
  std::string release();

  /// Valid for as long as this lives.
  board::Devices devices();
  std::vector<BusReport> buses() const;
  /// How the setup of the bus threads went.
  std::vector<hal_linux::SetupStep> steps() const;

 private:
  /// One bus's devices in the order in which they are served: duties before conversions.
  struct Bus {
    std::string name;
    std::vector<hal_linux::BusDevice*> duties;
    std::vector<hal_linux::BusDevice*> conversions;
  };
  class Taking;

  LinuxBoard() = default;

  hal_linux::MonotonicClock clock_;
  std::unique_ptr<hal::DigitalOutput> heartbeat_;
  std::unique_ptr<hal::DigitalInput> stop_circuit_;
  std::unique_ptr<hal::DigitalOutput> light_;
  std::unique_ptr<hal::AdcChannel> supply_;
  std::unique_ptr<hal::AdcChannel> air_;
  struct Channel {
    std::unique_ptr<hal::DigitalOutput> enable;
    std::unique_ptr<hal::PwmOutput> pwm;
    std::shared_ptr<hal::AdcChannel> position;  ///< shared in a joint or bundle
    std::unique_ptr<hal::AdcChannel> current;
  };
  std::vector<Channel> channels_;
  std::vector<Bus> buses_;
  std::optional<config::WatchdogAddress> watchdog_address_;
  std::unique_ptr<hal_linux::DevWatchdog> watchdog_;
  // Last, so that they are destroyed first: they use the devices.
  std::vector<std::unique_ptr<hal_linux::BusThread>> threads_;
};

}  // namespace supercoil::linux_board
