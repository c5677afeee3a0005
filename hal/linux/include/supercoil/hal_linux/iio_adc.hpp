// A converter's input, read on request.
#pragma once

#include <memory>

#include "supercoil/hal/adc_channel.hpp"
#include "supercoil/hal_linux/attribute.hpp"
#include "supercoil/hal_linux/iio_device.hpp"

namespace supercoil::hal_linux {

/// in_<input>_raw. How long a read takes depends on the driver: over I²C it blocks for a
/// millisecond and belongs in a BusThread. busy while a buffer of the same device is enabled.
class IioAdc final : public hal::AdcChannel {
 public:
  /// Reads once, so that a device that does not answer is found before anything is hot.
  static Result<std::unique_ptr<IioAdc>> open(const ConverterLocation& place);
  explicit IioAdc(Attribute raw) : raw_(std::move(raw)) {}

  /// The time is that before the read: a conversion made on request is never older than it seems.
  hal::Sample latest() override;

 private:
  Attribute raw_;
};

}  // namespace supercoil::hal_linux
