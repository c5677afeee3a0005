// The signals that end supercoild. Only the main thread waits for them.
#pragma once

#include <csignal>
#include <ctime>

#include "supercoil/hal/clock.hpp"

namespace supercoil::daemon {

/// A closed terminal sends SIGHUP. nohup makes the process ignore it; then it must not end
/// supercoild.
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

/// Call before threads are started: they inherit the mask.
inline void block_ending_signals() {
  const sigset_t signals = ending_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

/// Whether one of them is pending.
inline bool ending_signal_is_pending() {
  const sigset_t ending = ending_signals();
  sigset_t pending;
  sigpending(&pending);
  sigset_t both;
  sigandset(&both, &ending, &pending);
  return sigisemptyset(&both) == 0;
}

/// Waits up to `most`, which is less than a second, for one of them. Returns whether one came.
inline bool ending_signal_within(hal::Duration max_wait) {
  const sigset_t signals = ending_signals();
  const timespec time{0, static_cast<decltype(timespec::tv_nsec)>(max_wait.count())};
  return sigtimedwait(&signals, nullptr, &time) >= 0;
}

}  // namespace supercoil::daemon
