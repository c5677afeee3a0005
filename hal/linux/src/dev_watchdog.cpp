#include "supercoil/hal_linux/dev_watchdog.hpp"

#include <cerrno>
#include <cmath>

#include <fcntl.h>
#include <linux/watchdog.h>
#include <sys/ioctl.h>

namespace supercoil::hal_linux {

namespace {

/// The time-out that the driver accepted, or why it accepted none.
Result<int> set_timeout(const Descriptor& device, int wanted_s, const std::string& path) {
  int taken_s = wanted_s;
  if (::ioctl(device.number(), WDIOC_SETTIMEOUT, &taken_s) == 0) return taken_s;
  const int refused = errno;
  const std::string what =
      path + " does not accept a time-out of " + std::to_string(wanted_s) + " s";
  int has_s = 0;
  if (::ioctl(device.number(), WDIOC_GETTIMEOUT, &has_s) != 0) return failed_call(what, refused);
  if (has_s >= 1 && has_s <= wanted_s) return has_s;
  return failed_call(what + ", and has " + std::to_string(has_s) + " s", refused);
}

}  // namespace

Result<std::unique_ptr<DevWatchdog>> DevWatchdog::open(const std::string& path, double timeout_s) {
  constexpr double max_s = 86400.0;
  if (!(timeout_s > 0.0 && timeout_s <= max_s)) {
    return failure("a watchdog's time-out must be above 0 and at most a day");
  }
  auto device = open_file(path, O_WRONLY | O_NONBLOCK);
  if (!device) return tl::unexpected(device.error());
  watchdog_info info{};
  const bool known = ::ioctl(device->number(), WDIOC_GETSUPPORT, &info) == 0;
  const bool outlives_program = known && (info.options & WDIOF_MAGICCLOSE) != 0;
  const auto taken_s = set_timeout(*device, static_cast<int>(std::ceil(timeout_s)), path);
  auto watchdog =
      std::make_unique<DevWatchdog>(std::move(*device), taken_s.value_or(0), outlives_program);
  if (!taken_s) {
    // It has been running since it was opened, and would not be fed.
    static_cast<void>(watchdog->release());
    return tl::unexpected(taken_s.error());
  }
  return watchdog;
}

DevWatchdog::DevWatchdog(Descriptor device, int timeout_s, bool outlives_program)
    : device_(std::move(device)), timeout_s_(timeout_s), outlives_program_(outlives_program) {}

hal::Status DevWatchdog::feed() {
  if (!device_.is_open()) return hal::Status::gone;
  // Any byte but 'V' feeds it, with every driver; not all support WDIOC_KEEPALIVE.
  return write_next(device_, "\0", 1);
}

hal::Status DevWatchdog::release() {
  if (!device_.is_open()) return hal::Status::gone;
  // Closing does not report whether it stopped; this does, if the driver supports it. EBUSY:
  // nowayout.
  int disable = WDIOS_DISABLECARD;
  if (::ioctl(device_.number(), WDIOC_SETOPTIONS, &disable) != 0 && errno == EBUSY) {
    return hal::Status::out_of_range;
  }
  const hal::Status written = write_next(device_, "V", 1);
  if (written == hal::Status::ok) device_.close();
  return written;
}

}  // namespace supercoil::hal_linux
