#include <algorithm>
#include <cerrno>
#include <optional>
#include <system_error>
#include <vector>

#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include "supercoil/hal_linux/attribute.hpp"
#include "supercoil/hal_linux/checks.hpp"
#include "supercoil/hal_linux/device_folder.hpp"

namespace supercoil::hal_linux {

namespace {

using hal::Severity;

/// Of /dev/watchdog, which is another name for the first one.
constexpr unsigned misc_major = 10;
constexpr unsigned watchdog_minor = 130;

std::string identity(const DeviceFolder& folder) {
  return base_name(folder.folder) + " '" +
         read_text(folder.folder + "/identity").value_or("unknown") + "'";
}

/// Which of the machine's watchdogs the device is.
std::optional<DeviceFolder> behind(const struct stat& device,
                                   const std::vector<DeviceFolder>& all) {
  const unsigned major = ::gnu_dev_major(device.st_rdev);
  const unsigned minor = ::gnu_dev_minor(device.st_rdev);
  const bool first = major == misc_major && minor == watchdog_minor;
  const std::string number = std::to_string(major) + ":" + std::to_string(minor);
  const auto found = std::find_if(all.begin(), all.end(), [&](const DeviceFolder& folder) {
    if (first) return base_name(folder.folder) == "watchdog0";
    return read_text(folder.folder + "/dev").value_or("") == number;
  });
  if (found == all.end()) return {};
  return *found;
}

void print_missing(const std::string& path, int error, const std::string& root,
                   const std::vector<DeviceFolder>& all, const hal::FindingSink& sink) {
  std::vector<std::string> names;
  std::transform(all.begin(), all.end(), std::back_inserter(names), identity);
  sink({"watchdog", Severity::problem,
        path + ": " + std::generic_category().message(error) + "; in " + root +
            (names.empty() ? " there is none" : " there are " + listed(names)),
        "load its driver, or name the right device in board.watchdog"});
}

}  // namespace

void check_watchdog(const Machine& machine, const std::string& path, bool in_use,
                    const hal::FindingSink& sink) {
  const std::string what = "watchdog";
  const std::string root = machine.sys + "/class/watchdog";
  const auto all = numbered_folders(root, "watchdog").value_or(std::vector<DeviceFolder>{});
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return print_missing(path, errno, root, all, sink);
  if (!S_ISCHR(status.st_mode)) return print_missing(path, ENODEV, root, all, sink);
  if (::access(path.c_str(), W_OK) != 0) {
    sink({what, Severity::problem, path + ": " + std::generic_category().message(errno),
          "run as root, or let the service's user write to it"});
    return;
  }
  const auto folder = behind(status, all);
  if (!folder) {
    sink({what, Severity::warning, path + " exists; " + root + " does not identify it",
          "use a kernel with CONFIG_WATCHDOG_SYSFS, or look at wdctl"});
    return;
  }
  const std::string found = path + " is " + identity(*folder);
  if (!in_use && read_text(folder->folder + "/state").value_or("") == "active") {
    sink({what, Severity::problem, found + ", and another process uses it",
          "stop that process: RuntimeWatchdogSec=off for systemd, else the watchdog daemon"});
  } else if (read_text(folder->folder + "/nowayout").value_or("") == "1") {
    sink({what, Severity::warning, found + "; once started it cannot be stopped (nowayout)",
          "expect the board to be reset when supercoild ends, or load the driver with nowayout=0"});
  } else {
    sink({what, Severity::ok, found + "; not opened, since that starts it", ""});
  }
}

}  // namespace supercoil::hal_linux
