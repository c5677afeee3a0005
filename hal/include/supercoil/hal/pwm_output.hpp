// A PWM that drives a muscle's power switch.
#pragma once

#include "supercoil/hal/status.hpp"

namespace supercoil::hal {

/// One channel's duty. Owned by the channel's power stage. A direct output (on-chip) has taken the
/// duty when set() returns, within 20 µs. A buffered one (behind a bus) takes it later, from the
/// bus's own thread, and may stall: that is why the enable line, not the duty, is the timed cut.
/// Never blocks. After an error the duty is unknown: the caller makes the channel safe.
class PwmOutput {
 public:
  PwmOutput() = default;
  PwmOutput(const PwmOutput&) = delete;
  PwmOutput& operator=(const PwmOutput&) = delete;
  virtual ~PwmOutput() = default;

  /// step: 0 (off) to steps() (always on). out_of_range changes nothing.
  virtual Status set(int step) = 0;
  /// The step read back from the device. On sysfs that is only the kernel's cached value: proof of
  /// power is current. Negative when it cannot be read back, or while a buffered write is under
  /// way.
  virtual int read_back() const = 0;
  /// Steps of a full period, ≥ 1: 4095 for 12 bits.
  virtual int steps() const = 0;
};

}  // namespace supercoil::hal
