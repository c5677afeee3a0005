// Ctrl-C, SIGTERM and SIGHUP, as flags to poll.
#pragma once

#include <cerrno>
#include <csignal>

#include <unistd.h>

namespace supercoil::operating {

/// The signal; 0: none came.
inline volatile std::sig_atomic_t interrupted = 0;
inline volatile std::sig_atomic_t terminal_echoes = 0;

/// On a terminal a message after Ctrl-C needs a line of its own: ^C is echoed at the cursor, behind
/// a question or progress that is redrawn in place.
inline void watch_for_interrupts() {
  terminal_echoes = isatty(STDERR_FILENO);
  const auto note = [](int signal) {
    interrupted = signal;
    if (signal != SIGINT || terminal_echoes == 0) return;
    const int error = errno;
    static_cast<void>(!::write(STDERR_FILENO, "\n", 1));
    errno = error;
  };
  std::signal(SIGINT, note);
  std::signal(SIGTERM, note);
  // A closed terminal sends SIGHUP. Under nohup it stays ignored.
  if (std::signal(SIGHUP, note) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

/// The name of what interrupted the program.
inline const char* interrupter() {
  if (interrupted == SIGHUP) return "SIGHUP";
  return interrupted == SIGTERM ? "SIGTERM" : "Ctrl-C";
}

}  // namespace supercoil::operating
