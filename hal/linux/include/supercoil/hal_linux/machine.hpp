// The kernel's own folders.
#pragma once

#include <string>

namespace supercoil::hal_linux {

/// Where they are mounted.
struct Machine {
  std::string proc = "/proc";
  std::string sys = "/sys";
  std::string dev = "/dev";

  std::string pwm_chips() const { return sys + "/class/pwm"; }
  std::string converters() const { return sys + "/bus/iio/devices"; }
};

}  // namespace supercoil::hal_linux
