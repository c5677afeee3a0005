// What a board is wired to, as the loop sees it.
#pragma once

#include <vector>

#include "supercoil/hal/adc_channel.hpp"
#include "supercoil/hal/clock.hpp"
#include "supercoil/hal/digital_line.hpp"
#include "supercoil/hal/pwm_output.hpp"
#include "supercoil/hal/watchdog.hpp"

namespace supercoil::board {

/// One muscle's devices. They outlive the loop.
struct ChannelDevices {
  hal::PwmOutput* pwm;
  hal::DigitalOutput* enable;
  hal::AdcChannel* position;
  hal::AdcChannel* current;
};

/// A whole board's devices. Only those marked so may be null.
struct Devices {
  hal::Clock* clock;
  hal::AdcChannel* supply;
  hal::DigitalOutput* heartbeat;
  hal::DigitalInput* stop_circuit;  ///< high: closed
  hal::DigitalOutput* light;        ///< may be null: no status light
  hal::Watchdog* watchdog;          ///< may be null: none
  std::vector<ChannelDevices> channels;
  hal::AdcChannel* air = nullptr;  ///< air temperature; null: not measured
};

}  // namespace supercoil::board
