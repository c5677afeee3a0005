// Converters of the kernel's Industrial I/O.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "supercoil/hal/error.hpp"
#include "supercoil/hal_linux/device_folder.hpp"

namespace supercoil::hal_linux {

/// Where a converter's input is.
struct ConverterLocation {
  std::string device;  ///< IIO name, or the end of its device path when it holds a slash
  std::string input;   ///< e.g. voltage0, or voltage0-voltage1
  std::string root = "/sys/bus/iio/devices";
};

/// The converters in root.
Result<std::vector<DeviceFolder>> iio_devices(const std::string& root);
/// The converter that `device` names.
Result<DeviceFolder> find_iio_device(const std::string& device, const std::string& root);

/// Range of a converter's counts: at either end it is at its rail.
struct CountRange {
  std::int64_t min = 0;
  std::int64_t max = 0;
};

/// From the type of the input's scans; empty when the device has none.
std::optional<CountRange> count_range(const ConverterLocation& place);

/// Whether `input` may be part of a file's name: letters, digits, '-' and '_'.
bool is_input_name(const std::string& input);

}  // namespace supercoil::hal_linux
