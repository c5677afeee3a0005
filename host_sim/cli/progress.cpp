#include "cli/progress.hpp"

#include <cstdio>
#include <utility>

#include <unistd.h>

namespace supercoil::host_sim {

using namespace std::chrono_literals;

Progress::Progress(std::string what, bool quiet)
    : what_(std::move(what)),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) == 1),
      next_(start_ + 2s) {}

Progress::~Progress() {
  end();
}

void Progress::end() {
  if (shown_ && terminal_) std::fputs("\r\033[K", stderr);
  shown_ = false;
}

void Progress::show(double done, const std::string& detail) {
  const Clock::time_point now = Clock::now();
  if (quiet_ || now < next_) return;
  next_ = now + (terminal_ ? Clock::duration(200ms) : Clock::duration(10s));
  shown_ = true;
  std::fprintf(stderr, terminal_ ? "\r\033[K%s: %3.0f %%  %s" : "%s: %3.0f %%  %s\n", what_.c_str(),
               done * 100.0, detail.c_str());
  std::fflush(stderr);
}

double Progress::elapsed_s() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

}  // namespace supercoil::host_sim
