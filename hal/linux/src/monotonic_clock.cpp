#include "supercoil/hal_linux/monotonic_clock.hpp"

#include <cerrno>
#include <ctime>

namespace supercoil::hal_linux {

hal::Time MonotonicClock::time() noexcept {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec);
}

hal::Time MonotonicClock::wait_until(hal::Time wake) {
  // The kernel would sleep even for a time in the past, and give the CPU to others.
  if (const hal::Time now = time(); now >= wake) return now;
  const auto whole = std::chrono::floor<std::chrono::seconds>(wake);
  timespec until{};
  until.tv_sec = static_cast<std::time_t>(whole.count());
  until.tv_nsec = static_cast<decltype(timespec::tv_nsec)>((wake - whole).count());
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
  return time();
}

}  // namespace supercoil::hal_linux
