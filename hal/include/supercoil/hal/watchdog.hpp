// The hardware that resets a board whose firmware hangs.
#pragma once

#include "supercoil/hal/status.hpp"

namespace supercoil::hal {

/// Owned by the executive. Direct. It bites when it is not fed within its own time; release() is
/// for an orderly end only (magic close) and must not be called while any channel may be hot.
class Watchdog {
 public:
  Watchdog() = default;
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;
  virtual ~Watchdog() = default;

  /// Restarts its time-out.
  virtual Status feed() = 0;
  /// Stops it, so that the board is not reset after an orderly end.
  virtual Status release() = 0;
};

}  // namespace supercoil::hal
