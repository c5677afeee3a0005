// Notifications to systemd (sd_notify(3)).
#pragma once

#include <string_view>

#include "supercoil/hal/clock.hpp"

namespace supercoil::daemon {

/// One datagram to the socket that systemd names; without one nothing happens. Of libsystemd only
/// this would be used, and it would be the largest library in locked memory.
class Service {
 public:
  Service();

  /// "READY=1", "STATUS=…", "STOPPING=1".
  void notify(std::string_view state) const;
  /// Once every half of WatchdogSec: only while the caller knows that the loop is alive.
  void alive(hal::Time now);

 private:
  std::string_view socket_;
  hal::Duration alive_every_{};  ///< 0: systemd does not ask
  hal::Time next_{};
};

}  // namespace supercoil::daemon
