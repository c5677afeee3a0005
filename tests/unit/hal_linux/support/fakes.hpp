// Fake devices, for tests of the code that uses them.
#pragma once

#include <atomic>

#include "supercoil/hal/adc_channel.hpp"
#include "supercoil/hal/pwm_output.hpp"

namespace supercoil::test {

/// Another thread may set its answer.
struct FakeAdc final : hal::AdcChannel {
  hal::Sample latest() override {
    const int now = ++reads;
    return {now, hal::Time(now), status};
  }
  std::atomic<int> reads{0};
  std::atomic<hal::Status> status{hal::Status::ok};
};

struct FakePwm final : hal::PwmOutput {
  hal::Status set(int step) override {
    ++writes;
    if (status == hal::Status::ok) written = step;
    return status;
  }
  int read_back() const override { return written; }
  int steps() const override { return 1000; }
  std::atomic<int> writes{0};
  std::atomic<int> written{0};
  std::atomic<hal::Status> status{hal::Status::ok};
};

}  // namespace supercoil::test
