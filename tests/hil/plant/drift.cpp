// Preloaded into a program of the board: speeds up its CLOCK_MONOTONIC by SUPERCOIL_RIG_DRIFT_PPM,
// as on a board with another crystal. The kernel's stamps are of CLOCK_REALTIME and used as ages of
// some milliseconds, so they stay as they are.
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <ctime>

#include <sys/syscall.h>
#include <unistd.h>

namespace {

constexpr std::int64_t ns_per_s = 1'000'000'000;

double ratio() {
  static const double configured = [] {
    const char* ppm = std::getenv("SUPERCOIL_RIG_DRIFT_PPM");
    return ppm == nullptr ? 0.0 : 1e-6 * std::strtod(ppm, nullptr);
  }();
  return configured;
}

std::int64_t count(const timespec& time) {
  return time.tv_sec * ns_per_s + time.tv_nsec;
}
timespec time_of(std::int64_t ns) {
  return {ns / ns_per_s, ns % ns_per_s};
}

/// The ratio is small, so the double rounds its part by less than a nanosecond.
std::int64_t to_drifting(std::int64_t ns) {
  return ns + static_cast<std::int64_t>(static_cast<double>(ns) * ratio());
}
std::int64_t to_kernels(std::int64_t ns) {
  return ns - static_cast<std::int64_t>(static_cast<double>(ns) * ratio() / (1.0 + ratio()));
}

}  // namespace

extern "C" {

int clock_gettime(clockid_t clock, timespec* now) noexcept {
  const auto result = static_cast<int>(::syscall(SYS_clock_gettime, clock, now));
  if (result == 0 && clock == CLOCK_MONOTONIC) *now = time_of(to_drifting(count(*now)));
  return result;
}

int clock_nanosleep(clockid_t clock, int flags, const timespec* until, timespec* left) {
  timespec kernels = *until;
  if (clock == CLOCK_MONOTONIC && (flags & TIMER_ABSTIME) != 0)
    kernels = time_of(to_kernels(count(*until)));
  const bool failed = ::syscall(SYS_clock_nanosleep, clock, flags, &kernels, left) != 0;
  return failed ? errno : 0;  // syscall() gives -1 and errno; clock_nanosleep() the error itself
}
}
