// The hardware watchdog, through /dev/watchdog.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "supercoil/hal/watchdog.hpp"
#include "supercoil/hal_linux/descriptor.hpp"

namespace supercoil::hal_linux {

/// Opening it starts it. When this object ends without release(), the watchdog goes on and bites: a
/// crash does not stop it.
class DevWatchdog final : public hal::Watchdog {
 public:
  /// timeout_s: above 0; the driver counts whole seconds, and a fraction is rounded up. A driver
  /// that does not accept it must already have a shorter one; otherwise this is an error, and the
  /// watchdog is stopped again.
  static Result<std::unique_ptr<DevWatchdog>> open(const std::string& path, double timeout_s);
  DevWatchdog(Descriptor device, int timeout_s, bool outlives_program);

  hal::Status feed() override;
  /// Stops it. out_of_range when the driver refuses to stop ("nowayout"): it must still be fed
  /// then. After a success feed() answers gone.
  hal::Status release() override;

  /// The time-out that the driver really uses.
  int timeout_s() const { return timeout_s_; }
  /// False: the driver stops the watchdog when its file is closed, so also when the program crashes
  /// (it has no WDIOF_MAGICCLOSE). It then guards only against a hang.
  bool outlives_program() const { return outlives_program_; }

 private:
  Descriptor device_;
  int timeout_s_;
  bool outlives_program_;
};

}  // namespace supercoil::hal_linux
