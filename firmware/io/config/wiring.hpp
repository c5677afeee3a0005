// Which device of the operating system is which part of the board. Addresses only; nothing is
// opened here.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace supercoil::config {

/// A GPIO line, by names that do not change with the kernel. Always direct: set within 20 µs.
struct LineAddress {
  std::string chip;  ///< label, as gpiodetect shows it
  std::string line;  ///< name, as gpioinfo shows it

  friend bool operator==(const LineAddress&, const LineAddress&) = default;
};

/// What one access to a buffered device costs its bus; all 0 for a direct one.
struct Access {
  std::string bus;  ///< empty: direct, called in the tick
  int transactions = 0;
  int bytes = 0;        ///< of each transaction, addresses included
  double wait_s = 0.0;  ///< time that the bus's thread is blocked besides (a conversion)

  bool buffered() const { return !bus.empty(); }
};

/// One output of a PWM chip.
struct PwmAddress {
  std::string device;  ///< the chip's name, or the end of its device path when it holds a slash
  int number = 0;      ///< of the output on its chip
  std::int64_t period_ns = 0;
  int steps = 4095;  ///< of a period
  Access access;
};

/// The kernel converts at a trigger's times and keeps the results; a tick takes the newest.
struct Capture {
  std::string trigger;  ///< its name
  int length = 64;      ///< conversions that the kernel keeps; more than come in a tick

  friend bool operator==(const Capture&, const Capture&) = default;
};

/// One input of an IIO converter.
struct ConverterAddress {
  std::string device;  ///< IIO name, or the end of its device path when it holds a slash
  std::string input;   ///< e.g. voltage0
  Access access;
  std::optional<Capture> capture;  ///< the same for all inputs of a device; then it is direct
};

/// Decides how many bits a byte takes on the bus.
enum class BusKind { i2c, spi };

/// A bus has a thread of its own that serves every device on it once a tick.
struct BusAddress {
  std::string name;  ///< e.g. i2c-1
  BusKind kind = BusKind::i2c;
  double clock_Hz = 100e3;
  double overhead_s = 20e-6;  ///< of a transaction, besides its bits: the kernel's and the driver's
};

/// The watchdog that resets the board if it is not fed for timeout_s.
struct WatchdogAddress {
  std::string device;
  double timeout_s = 5.0;
};

/// What one channel is wired to.
struct ChannelWiring {
  LineAddress enable;
  PwmAddress pwm;
  ConverterAddress position;
  ConverterAddress current;
  /// The channel that owns this position's converter; empty: this one.
  std::optional<std::size_t> position_of;
};

/// What a board is wired to; a part that is empty is not fitted.
struct BoardWiring {
  LineAddress heartbeat;
  LineAddress stop_circuit;
  std::optional<LineAddress> light;
  std::optional<WatchdogAddress> watchdog;
  ConverterAddress supply;
  std::optional<ConverterAddress> air;  ///< the air's temperature
  std::vector<BusAddress> buses;
  std::vector<ChannelWiring> channels;
};

}  // namespace supercoil::config
