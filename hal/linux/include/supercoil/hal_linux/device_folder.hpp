// Finds a device of sysfs by a name that does not change with the kernel.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "supercoil/hal/error.hpp"

namespace supercoil::hal_linux {

/// A device as sysfs shows it.
struct DeviceFolder {
  std::string folder;              ///< /sys/class/pwm/pwmchip0
  std::vector<std::string> names;  ///< what it may be called; the first is the usual one
  std::string device_path;         ///< of the hardware: /sys/devices/…/i2c-1/1-0040

  /// "pwmchip0 'pca9685' at /sys/devices/…/i2c-1/1-0040".
  std::string describe() const;
};

/// Every folder of `root` whose name is `prefix` and a number, ordered by number.
Result<std::vector<DeviceFolder>> numbered_folders(const std::string& root,
                                                   std::string_view prefix);

/// The device in `all` that `wanted` names: by one of its names or, if it contains a slash, by the
/// end of its device path. No match, or more than one, is an error that lists the devices. kind:
/// "PWM chip".
Result<DeviceFolder> choose(const std::vector<DeviceFolder>& all, std::string_view wanted,
                            std::string_view kind, const std::string& root);

/// The path with all links resolved; empty when there is none.
std::string real_path(const std::string& path);
/// The part after the last slash; the part before it.
std::string base_name(const std::string& path);
std::string parent_of(const std::string& path);
/// "a, b, c"; beyond 12 names the rest is only counted.
std::string listed(const std::vector<std::string>& items);
/// The names in a folder, sorted.
Result<std::vector<std::string>> names_in(const std::string& folder);

}  // namespace supercoil::hal_linux
