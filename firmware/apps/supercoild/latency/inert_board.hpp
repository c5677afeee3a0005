// A board without devices: for measuring the loop with nothing that could heat.
#pragma once

#include <cstddef>

#include "supercoil/hal_linux/monotonic_clock.hpp"

#include "board/devices.hpp"

namespace supercoil::daemon {

/// Outputs lead nowhere, and no input ever has a value. For the loop that is an emergency stop that
/// lasts: no channel can be armed. Nothing of the machine is opened.
class InertBoard {
 public:
  /// For as long as this lives.
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
