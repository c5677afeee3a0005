// Single wires: enable, heartbeat, status light, emergency stop.
#pragma once

#include "supercoil/hal/status.hpp"

namespace supercoil::hal {

/// An output. Always direct: the line has its level when set() returns, within 20 µs. Never blocks.
class DigitalOutput {
 public:
  DigitalOutput() = default;
  DigitalOutput(const DigitalOutput&) = delete;
  DigitalOutput& operator=(const DigitalOutput&) = delete;
  virtual ~DigitalOutput() = default;

  /// Any status but ok: the level may be the old one or the new one.
  virtual Status set(bool high) = 0;
};

/// An input's level, or why it cannot be read. A caller that depends on it for safety treats every
/// status but ok as the dangerous level.
struct Level {
  bool high = false;
  Status status = Status::not_ready;
};

/// An input. Direct; never blocks.
class DigitalInput {
 public:
  DigitalInput() = default;
  DigitalInput(const DigitalInput&) = delete;
  DigitalInput& operator=(const DigitalInput&) = delete;
  virtual ~DigitalInput() = default;

  /// The level now, within 20 µs.
  virtual Level read() = 0;
};

}  // namespace supercoil::hal
