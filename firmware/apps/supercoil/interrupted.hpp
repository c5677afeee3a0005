// Ctrl-C and SIGTERM, seen at the next look.
#pragma once

#include <csignal>

namespace supercoil::operating {

inline volatile std::sig_atomic_t interrupted = 0;

inline void watch_for_interrupts() {
  const auto note = [](int) { interrupted = 1; };
  std::signal(SIGINT, note);
  std::signal(SIGTERM, note);
}

}  // namespace supercoil::operating
