// Notifications to systemd (sd_notify(3)).
#pragma once

#include <string_view>

#include "supercoil/hal/clock.hpp"

namespace supercoil::daemon {

/// Sends one datagram to the socket that systemd names; without one it does nothing. libsystemd
/// would be used for this alone, and would be the largest library in locked memory.
class Service {
 public:
  Service();

  /// "READY=1", "STATUS=…", "STOPPING=1".
  void notify(std::string_view state) const;
  /// Call only while the loop is known to be alive. Notifies every half of WatchdogSec.
  void alive(hal::Time now);

 private:
  std::string_view socket_;
  hal::Duration alive_every_{};  ///< 0: systemd does not ask for it
  hal::Time next_{};
};

}  // namespace supercoil::daemon
