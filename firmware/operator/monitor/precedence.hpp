// STOP before everything else that runs on the machine.
#pragma once

#include <sys/resource.h>

namespace supercoil::operating {

/// The calling thread gets the processor before others do, where the system lets this user have
/// that (RLIMIT_NICE). No real-time priority: whoever floods STOP's port would take a processor
/// from all else.
inline void take_precedence() {
  constexpr int nice = -10;
  const id_t this_thread = 0;
  if (::getpriority(PRIO_PROCESS, this_thread) > nice) {
    static_cast<void>(::setpriority(PRIO_PROCESS, this_thread, nice));
  }
}

}  // namespace supercoil::operating
