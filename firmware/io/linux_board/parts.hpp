// Opens a board's devices as its configuration names them, for every program that uses them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "supercoil/hal_linux/gpio_line.hpp"
#include "supercoil/hal_linux/iio_adc.hpp"
#include "supercoil/hal_linux/machine.hpp"
#include "supercoil/hal_linux/sysfs_pwm.hpp"

#include "config/wiring.hpp"

namespace supercoil::linux_board {

/// A device, or an error that says where it was looked for and what is there instead.
template <class Device>
struct Part {
  std::string what;  ///< "channel 1, enable"
  Result<std::unique_ptr<Device>> device;
};

using OutputPart = Part<hal_linux::GpioOutput>;
using InputPart = Part<hal_linux::GpioInput>;
using PwmPart = Part<hal_linux::SysfsPwm>;
using ConverterPart = Part<hal::AdcChannel>;

struct ChannelParts {
  OutputPart enable;
  PwmPart pwm;
  std::optional<ConverterPart> position;  ///< empty: another channel's (ChannelWiring::position_of)
  ConverterPart current;
};

/// Opened devices are off: lines low, duties 0. They are left so when this ends.
struct Parts {
  OutputPart heartbeat;
  std::vector<ChannelParts> channels;
  InputPart stop_circuit;
  std::optional<OutputPart> light;
  ConverterPart supply;
  std::optional<ConverterPart> air;

  /// A line for each device that cannot be opened.
  std::vector<std::string> missing() const;
};

/// Opens the lines that cut the heat, then PWMs, then the rest. The caller holds the board's lock.
Parts open_parts(const config::BoardWiring& wiring, const hal_linux::Machine& machine = {});

/// "channel 2, pwm"; index from 0.
std::string part_name(std::size_t index, const std::string& what);
hal_linux::LineName line_name(const config::LineAddress& address);
hal_linux::ConverterLocation converter_place(const config::ConverterAddress& address,
                                             const hal_linux::Machine& machine);

}  // namespace supercoil::linux_board
