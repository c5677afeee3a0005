// A board without devices, to measure the loop without anything that could heat.
#pragma once

#include <cstddef>

#include "supercoil/hal_linux/monotonic_clock.hpp"

#include "board/devices.hpp"

namespace supercoil::daemon {

/// Outputs go nowhere, and inputs never have a value. To the loop this is a permanent emergency
/// stop: no channel can be armed. No device of the machine is opened.
class InertBoard {
 public:
  /// Valid while this object lives.
  board::Devices devices(std::size_t channels) {
    board::Devices all{&clock_, &converter_, &output_, &stop_circuit_, nullptr, nullptr, {}};
    all.channels.assign(channels, {&pwm_, &output_, &converter_, &converter_});
    return all;
  }

 private:
  struct Pwm final : hal::PwmOutput {
    hal::Status set(int) override { return hal::Status::ok; }
    int read_back() const override { return 0; }
    int steps() const override { return 4095; }
  };
  struct Output final : hal::DigitalOutput {
    hal::Status set(bool) override { return hal::Status::ok; }
  };
  struct Input final : hal::DigitalInput {
    hal::Level read() override { return {}; }
  };
  struct Converter final : hal::AdcChannel {
    hal::Sample latest() override { return {}; }
  };

  hal_linux::MonotonicClock clock_;
  Pwm pwm_;
  Output output_;
  Input stop_circuit_;
  Converter converter_;
};

}  // namespace supercoil::daemon
