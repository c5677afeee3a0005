#include "supercoil/hal_linux/dev_watchdog.hpp"

#include <cerrno>
#include <cmath>
#include <string>

#include <linux/watchdog.h>

#include <CppUTest/TestHarness.h>

#include "supercoil/hal_linux/status_of.hpp"

#include "unit/hal_linux/support/system_calls.hpp"
#include "unit/hal_linux/support/temporary_folder.hpp"

using namespace supercoil;
using namespace supercoil::hal_linux;
using namespace supercoil::test;

TEST_GROUP(DevWatchdog) {
  TemporaryFolder dev;
  // The properties of the driver.
  unsigned options = WDIOF_MAGICCLOSE | WDIOF_SETTIMEOUT;
  int max_s = 60;
  int has_s = 30;
  int step_s = 1;
  bool nowayout = false;

  void setup() override {
    dev.write("watchdog", "");
    set_control(
        [this](unsigned long request, void* argument) { return control(request, argument); });
  }
  void teardown() override {
    reset_calls();
  }

  long control(unsigned long request, void* argument) {
    if (request == WDIOC_GETSUPPORT) {
      static_cast<watchdog_info*>(argument)->options = options;
    } else if (request == WDIOC_SETTIMEOUT) {
      int& wanted_s = *static_cast<int*>(argument);
      if (wanted_s > max_s) return -EINVAL;
      has_s = wanted_s = (wanted_s + step_s - 1) / step_s * step_s;
    } else if (request == WDIOC_GETTIMEOUT) {
      *static_cast<int*>(argument) = has_s;
    } else if (request == WDIOC_SETOPTIONS) {
      return nowayout ? -EBUSY : 0;
    } else {
      return -ENOTTY;
    }
    return 0;
  }
  std::string written() const {
    return dev.read("watchdog");
  }
  Result<std::unique_ptr<hal_linux::DevWatchdog>> open(double timeout_s) const {
    return hal_linux::DevWatchdog::open(dev / "watchdog", timeout_s);
  }
  static void check_status(hal::Status expected, hal::Status status) {
    STRCMP_EQUAL(hal::text(expected), hal::text(status));
  }
};

TEST(DevWatchdog, RoundsUpToWholeSeconds) {
  LONGS_EQUAL(5, (*open(5.0))->timeout_s());
  LONGS_EQUAL(2, (*open(1.2))->timeout_s());
  LONGS_EQUAL(1, (*open(0.1))->timeout_s());
}

TEST(DevWatchdog, ReportsTheTimeoutThatTheDriverChose) {
  step_s = 8;
  LONGS_EQUAL(8, (*open(5.0))->timeout_s());
}

TEST(DevWatchdog, RefusesInvalidTimes) {
  max_s = 1'000'000;
  for (const double timeout_s : {0.0, -1.0, 86400.5, 1e9, std::nan("")}) {
    CHECK_FALSE(open(timeout_s).has_value());
  }
  STRCMP_EQUAL("", written().c_str());
  LONGS_EQUAL(86400, (*open(86400.0))->timeout_s());
}

TEST(DevWatchdog, AcceptsAFixedShorterTimeoutOfTheDriver) {
  max_s = 0;
  has_s = 3;
  LONGS_EQUAL(3, (*open(5.0))->timeout_s());
}

TEST(DevWatchdog, IsStoppedAgainWhenItsTimeIsTooLong) {
  max_s = 0;
  has_s = 30;
  STRCMP_EQUAL(
      (dev / "watchdog" + " does not accept a time-out of 5 s, and has 30 s: Invalid argument")
          .c_str(),
      open(5.0).error().text().c_str());
  STRCMP_EQUAL("V", written().c_str());
}

TEST(DevWatchdog, IsFedWithoutTheMagicLetter) {
  const auto watchdog = open(5.0);
  for (int i = 0; i < 3; ++i)
    check_status(hal::Status::ok, (*watchdog)->feed());
  CHECK(written() == std::string(3, '\0'));
}

TEST(DevWatchdog, KeepsRunningWhenTheProgramEndsWithoutReleasingIt) {
  { const auto watchdog = open(5.0); }
  STRCMP_EQUAL("", written().c_str());
}

TEST(DevWatchdog, IsStoppedByTheMagicLetter) {
  const auto watchdog = open(5.0);
  check_status(hal::Status::ok, (*watchdog)->release());
  STRCMP_EQUAL("V", written().c_str());
  check_status(hal::Status::gone, (*watchdog)->feed());
  check_status(hal::Status::gone, (*watchdog)->release());
}

TEST(DevWatchdog, KeepsBeingFedWhenItCannotBeStopped) {
  nowayout = true;
  const auto watchdog = open(5.0);
  check_status(hal::Status::out_of_range, (*watchdog)->release());
  check_status(hal::Status::ok, (*watchdog)->feed());
  CHECK(written() == std::string(1, '\0'));
}

TEST(DevWatchdog, ReportsWhetherItOutlivesTheProgram) {
  CHECK((*open(5.0))->outlives_program());
  options = WDIOF_SETTIMEOUT;
  CHECK_FALSE((*open(5.0))->outlives_program());
}

TEST(DevWatchdog, PassesOnWhyItCouldNotBeFed) {
  const auto watchdog = open(5.0);
  for (const int error : {EIO, ENODEV, EBUSY, EAGAIN}) {
    fail_next(Call::write, "/watchdog", error);
    check_status(status_of(error), (*watchdog)->feed());
    fail_next(Call::write, "/watchdog", error);
    check_status(status_of(error), (*watchdog)->release());
  }
  fail_next(Call::write, "/watchdog", EINTR, 2);
  check_status(hal::Status::ok, (*watchdog)->feed());
}

TEST(DevWatchdog, FailsToOpenWhenBusyOrMissing) {
  fail_next(Call::open, "/watchdog", EBUSY);
  // For a file that is not open, the error names the path that was asked for.
  STRCMP_CONTAINS("watchdog: Device or resource busy", open(5.0).error().text().c_str());
  dev.remove("watchdog");
  LONGS_EQUAL(ENOENT, open(5.0).error().code);
  dev.make_folder("watchdog");
  LONGS_EQUAL(EISDIR, open(5.0).error().code);
  dev.remove("watchdog");
  dev.make_pipe("watchdog");
  LONGS_EQUAL(ENXIO, open(5.0).error().code);
}
