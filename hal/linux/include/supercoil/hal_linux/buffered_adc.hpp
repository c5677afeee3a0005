// A converter behind a slow bus, as the loop sees it.
#pragma once

#include <memory>
#include <utility>

#include "supercoil/hal/adc_channel.hpp"
#include "supercoil/hal_linux/bus_device.hpp"
#include "supercoil/hal_linux/mailbox.hpp"

namespace supercoil::hal_linux {

/// Hands the newest conversion from the bus's thread to the loop's. A device that fails is told by
/// the status; counts and time are then those of the last good conversion.
class BufferedAdc final : public hal::AdcChannel, public BusDevice {
 public:
  explicit BufferedAdc(std::unique_ptr<hal::AdcChannel> device) : device_(std::move(device)) {}

  /// The loop's.
  hal::Sample latest() override { return box_.newest(); }

  /// The bus's thread's.
  void serve() override {
    const hal::Sample sample = device_->latest();
    // No new conversion: the last one ages in the box.
    if (sample.status == hal::Status::not_ready) return;
    if (sample.status == hal::Status::ok) {
      last_ = sample;
    } else {
      last_.status = sample.status;
    }
    box_.put(last_);
  }

 private:
  std::unique_ptr<hal::AdcChannel> device_;
  hal::Sample last_;
  Mailbox<hal::Sample> box_;
};

}  // namespace supercoil::hal_linux
