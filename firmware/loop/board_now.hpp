// What the whole board tells its channels at a tick.
#pragma once

#include <cstdint>

#include "supercoil/hal/clock.hpp"

#include "board/measurement.hpp"
#include "supervisor/detectors/margin.hpp"
#include "supervisor/fault.hpp"

namespace supercoil {

struct BoardNow {
  hal::Time time{};
  double supply_V = 0.0;
  Fault fault = Fault::none;  ///< of the board, latched or present: every channel is made safe
  detectors::Margin margin;   ///< of that fault
  bool testing = true;        ///< the self-test runs: nothing is latched
  bool proven = false;        ///< it has passed: both ways of cutting cut
  std::int64_t periods = 1;   ///< since the last tick
  const board::Measured* air = nullptr;  ///< in °C; null: no sensor
};

}  // namespace supercoil
