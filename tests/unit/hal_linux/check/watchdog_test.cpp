#include <cerrno>

#include <CppUTest/TestHarness.h>

#include "supercoil/hal_linux/checks.hpp"

#include "unit/hal_linux/check/findings.hpp"
#include "unit/hal_linux/support/system_calls.hpp"
#include "unit/hal_linux/support/temporary_folder.hpp"

using namespace supercoil;
using namespace supercoil::hal_linux;
using namespace supercoil::test;

TEST_GROUP(CheckWatchdog) {
  TemporaryFolder root;
  const Machine machine{root / "proc", root / "sys", root / "dev"};
  const std::string first = "sys/class/watchdog/watchdog0/";
  /// A device that exists everywhere stands in for the watchdog.
  const std::string device = "/dev/null";
  bool opened = false;

  void setup() override {
    root.write(first + "identity", "i6300ESB timer\n");
    root.write(first + "dev", "1:3\n");
    root.write(first + "state", "inactive\n");
    root.write(first + "nowayout", "0\n");
    // Opening would start it.
    next(Call::open, device, [this] {
      opened = true;
      return -1;
    });
  }
  void teardown() override {
    CHECK_FALSE(opened);
    reset_calls();
  }
  hal::Finding found(const std::string& path, bool in_use = false) const {
    CollectedFindings collected;
    check_watchdog(machine, path, in_use, collected.sink());
    LONGS_EQUAL(1, collected.findings.size());
    return collected.findings.front();
  }
};

TEST(CheckWatchdog, IdentifiesItWithoutOpeningIt) {
  check_finding("ok", "/dev/null is watchdog0 'i6300ESB timer'", "", found(device));
}

TEST(CheckWatchdog, ListsTheAvailableWatchdogs) {
  check_finding("problem",
                root / "dev/watchdog" + ": No such file or directory; in " +
                    root / "sys/class/watchdog" + " there are watchdog0 'i6300ESB timer'",
                "load its driver", found(root / "dev/watchdog"));
  root.write("dev/watchdog", "");
  check_finding("problem", root / "dev/watchdog" + ": No such device", "load its driver",
                found(root / "dev/watchdog"));
  root.remove("sys");
  check_finding("problem", "there is none", "load its driver", found(root / "dev/none"));
}

TEST(CheckWatchdog, ReportsThatAnotherProgramHasIt) {
  root.write(first + "state", "active\n");
  check_finding("problem", "another process uses it", "RuntimeWatchdogSec=off", found(device));
  check_finding("ok", "is watchdog0", "", found(device, true));
}

TEST(CheckWatchdog, ReportsThatItCannotBeStopped) {
  root.write(first + "nowayout", "1\n");
  check_finding("warning", "cannot be stopped (nowayout)", "nowayout=0", found(device));
}

TEST(CheckWatchdog, ReportsThatThisUserMayNotWriteToIt) {
  fail_next(Call::access, device, EACCES);
  check_finding("problem", "/dev/null: Permission denied", "run as root", found(device));
}

TEST(CheckWatchdog, ReportsAnUnknownWatchdog) {
  root.write(first + "dev", "10:131\n");
  check_finding("warning", "/dev/null exists; ", "CONFIG_WATCHDOG_SYSFS", found(device));
}

TEST(CheckWatchdog, IdentifiesTheFirstOneByItsOtherName) {
  // /dev/watchdog has its own numbers, which no folder shows.
  root.write(first + "dev", "250:0\n");
  set_device(10, 130);
  check_finding("ok", "/dev/null is watchdog0 'i6300ESB timer'", "", found(device));
  set_device(250, 0);
  check_finding("ok", "/dev/null is watchdog0 'i6300ESB timer'", "", found(device));
  for (const auto& [major, minor] : {std::pair(10U, 131U), {11U, 130U}, {250U, 1U}}) {
    set_device(major, minor);
    check_finding("warning", "does not identify it", "wdctl", found(device));
  }
}

TEST(CheckWatchdog, DoesNotMistakeAnotherOneForTheFirst) {
  TemporaryFolder without_first;
  without_first.write("sys/class/watchdog/watchdog1/identity", "other\n");
  without_first.write("sys/class/watchdog/watchdog1/dev", "250:1\n");
  const Machine other{without_first / "proc", without_first / "sys", without_first / "dev"};
  set_device(10, 130);
  CollectedFindings collected;
  check_watchdog(other, device, false, collected.sink());
  check_finding("warning", "does not identify it", "wdctl", collected.findings.front());
}
