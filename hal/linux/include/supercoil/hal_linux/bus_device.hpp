// What a bus's thread does for each device.
#pragma once

namespace supercoil::hal_linux {

/// A device behind a bus.
class BusDevice {
 public:
  BusDevice() = default;
  BusDevice(const BusDevice&) = delete;
  BusDevice& operator=(const BusDevice&) = delete;
  virtual ~BusDevice() = default;

  /// Called only by the bus's thread, once a period. May block for as long as the bus does.
  /// Failures are reported through the device's own answers.
  virtual void serve() = 0;
};

}  // namespace supercoil::hal_linux
