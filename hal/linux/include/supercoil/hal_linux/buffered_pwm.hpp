// A PWM behind a slow bus, as the loop sees it.
#pragma once

#include <cstdint>
#include <memory>

#include "supercoil/hal/pwm_output.hpp"
#include "supercoil/hal_linux/bus_device.hpp"
#include "supercoil/hal_linux/mailbox.hpp"

namespace supercoil::hal_linux {

/// Hands the newest duty from the loop's thread to the bus's, and the last write's result back.
class BufferedPwm final : public hal::PwmOutput, public BusDevice {
 public:
  /// After this many sets without a write in between, set() answers busy.
  static constexpr int max_unserved = 10;

  explicit BufferedPwm(std::unique_ptr<hal::PwmOutput> device);

  /// Called by the loop's thread. Hands `step` over unless out_of_range, and answers how the last
  /// finished write went; busy when the bus has stalled, so that a stall does not pass for success.
  hal::Status set(int step) override;
  /// Negative from set() until the bus's thread has written that very step.
  int read_back() const override;
  int steps() const override { return steps_; }

  /// Called by the bus's thread. Writes a new step, and writes again after a failure.
  void serve() override;

 private:
  struct Request {
    int step = 0;
    std::uint32_t number = 0;  ///< counts requests; 0: none yet
  };
  struct Written {
    std::uint32_t number = 0;  ///< of the request that was written
    hal::Status status = hal::Status::ok;
    int read_back = -1;
  };

  std::unique_ptr<hal::PwmOutput> device_;
  int steps_;
  Request request_;         ///< the loop's
  std::uint32_t seen_ = 0;  ///< the loop's: the last write that it knows of
  int unserved_ = 0;        ///< the loop's
  Written written_;         ///< the bus's thread's
  Mailbox<Request> requests_;
  mutable Mailbox<Written> results_;
};

}  // namespace supercoil::hal_linux
