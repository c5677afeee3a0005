// A converter behind a slow bus, as the loop sees it.
#pragma once

#include <memory>
#include <utility>

#include "supercoil/hal/adc_channel.hpp"
#include "supercoil/hal_linux/bus_device.hpp"
#include "supercoil/hal_linux/mailbox.hpp"

namespace supercoil::hal_linux {

/// Hands the newest conversion from the bus's thread to the loop's. When the device fails, the
/// status says so; counts and time are then those of the last good conversion.
class BufferedAdc final : public hal::AdcChannel, public BusDevice {
 public:
  explicit BufferedAdc(std::unique_ptr<hal::AdcChannel> device) : device_(std::move(device)) {}

  /// Called by the loop's thread.
  hal::Sample latest() override { return box_.newest(); }

  /// Called by the bus's thread.
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
