// What a bus's thread does for each device.
#pragma once

namespace supercoil::hal_linux {

/// A device behind a bus.
class Served {
 public:
  Served() = default;
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;
  virtual ~Served() = default;

  /// Called by the bus's thread alone, once a period. May block for as long as the bus does. Tells
  /// of failures through the device's own answers.
  virtual void serve() = 0;
};

}  // namespace supercoil::hal_linux
