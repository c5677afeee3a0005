// The signals that end supercoild: they are waited for, by the main thread alone.
#pragma once

#include <csignal>
#include <ctime>

#include "supercoil/hal/clock.hpp"

namespace supercoil::daemon {

/// SIGHUP is what a terminal sends that is closed; nohup makes it ignored, and then it ends
/// nothing.
inline sigset_t ending_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGTERM);
  sigaddset(&set, SIGINT);
  struct sigaction hangup {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) sigaddset(&set, SIGHUP);
  return set;
}

/// Before there are threads: they inherit it.
inline void block_ending_signals() {
  const sigset_t signals = ending_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

/// One of them is pending.
inline bool ending_signal_is_pending() {
  const sigset_t ending = ending_signals();
  sigset_t pending;
  sigpending(&pending);
  sigset_t both;
  sigandset(&both, &ending, &pending);
  return sigisemptyset(&both) == 0;
}

/// Waits so long, less than a second, for one of them; whether it came.
inline bool ending_signal_within(hal::Duration most) {
  const sigset_t signals = ending_signals();
  const timespec time{0, static_cast<decltype(timespec::tv_nsec)>(most.count())};
  return sigtimedwait(&signals, nullptr, &time) >= 0;
}

}  // namespace supercoil::daemon
