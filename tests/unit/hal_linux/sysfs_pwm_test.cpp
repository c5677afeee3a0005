#include "supercoil/hal_linux/sysfs_pwm.hpp"

#include <cerrno>
#include <string>

#include <CppUTest/TestHarness.h>

#include "supercoil/hal_linux/status_of.hpp"

#include "unit/hal_linux/support/check_status.hpp"
#include "unit/hal_linux/support/pwm_kernel.hpp"
#include "unit/hal_linux/support/system_calls.hpp"

using namespace supercoil;
using namespace supercoil::hal_linux;
using namespace supercoil::test;

namespace {

std::unique_ptr<SysfsPwm> opened(const PwmKernel& kernel) {
  auto pwm = SysfsPwm::open({"i2c-1/1-0040", 5, 1'000'000, 4000, kernel.root()});
  if (!pwm) FAIL(pwm.error().text().c_str());
  return std::move(*pwm);
}

}  // namespace

TEST_GROUP(SysfsPwm){};

TEST(SysfsPwm, ExportsItsOutputIfNotExported) {
  PwmKernel kernel({}, false);
  const auto pwm = opened(kernel);
  STRCMP_EQUAL("export 5", kernel.writes.front().c_str());
}

TEST(SysfsPwm, DoesNotExportAnExportedOutput) {
  PwmKernel kernel;
  const auto pwm = opened(kernel);
  STRCMP_EQUAL("period 1000000", kernel.writes.front().c_str());
}

TEST(SysfsPwm, IsFoundByEachOfItsNames) {
  for (const char* name : {"pca9685", "1-0040", "i2c-1/1-0040", "soc/i2c-1/1-0040"}) {
    PwmKernel kernel;
    CHECK(SysfsPwm::open({name, 5, 1'000'000, 4000, kernel.root()}).has_value());
  }
}

TEST(SysfsPwm, WritesADutyAsAFractionOfItsPeriod) {
  PwmKernel kernel;
  const auto pwm = opened(kernel);
  check_status(hal::Status::ok, pwm->set(1000));
  LONGS_EQUAL(250'000, kernel.state.duty_ns);
  check_status(hal::Status::ok, pwm->set(4000));
  LONGS_EQUAL(1'000'000, kernel.state.duty_ns);
  check_status(hal::Status::ok, pwm->set(0));
  LONGS_EQUAL(0, kernel.state.duty_ns);
}

TEST(SysfsPwm, RefusesAStepOutOfRangeAndChangesNothing) {
  PwmKernel kernel;
  const auto pwm = opened(kernel);
  check_status(hal::Status::ok, pwm->set(7));
  const auto before = kernel.writes.size();
  for (const int step : {-1, 4001, 1 << 30})
    check_status(hal::Status::out_of_range, pwm->set(step));
  LONGS_EQUAL(before, kernel.writes.size());
  LONGS_EQUAL(7, pwm->read_back());
}

TEST(SysfsPwm, ReadsBackTheKernelsDuty) {
  PwmKernel kernel;
  const auto pwm = opened(kernel);
  check_status(hal::Status::ok, pwm->set(2000));
  kernel.tree.write("class/pwm/pwmchip3/pwm5/duty_cycle", "100000\n");
  LONGS_EQUAL(400, pwm->read_back());
}

TEST(SysfsPwm, ReadsBackNothingWithoutAPlausibleDuty) {
  PwmKernel kernel;
  const auto pwm = opened(kernel);
  for (const char* duty : {"", "text\n", "-1\n", "1000001\n", "99999999999999999999\n"}) {
    kernel.tree.write("class/pwm/pwmchip3/pwm5/duty_cycle", duty);
    LONGS_EQUAL(-1, pwm->read_back());
  }
  fail_next(Call::pread, "/duty_cycle", EIO);
  LONGS_EQUAL(-1, pwm->read_back());
}

TEST(SysfsPwm, ZeroesItsDutyBeforeItIsDisabledWhenItEnds) {
  PwmKernel kernel;
  auto pwm = opened(kernel);
  check_status(hal::Status::ok, pwm->set(4000));
  pwm.reset();
  const auto count = kernel.writes.size();
  STRCMP_EQUAL("duty_cycle 0", kernel.writes.at(count - 2).c_str());
  STRCMP_EQUAL("enable 0", kernel.writes.at(count - 1).c_str());
  CHECK_FALSE(kernel.state.enabled);
}

TEST(SysfsPwm, IsDisabledAtItsEndEvenIfItsDutyCannotBeZeroed) {
  PwmKernel kernel;
  auto pwm = opened(kernel);
  check_status(hal::Status::ok, pwm->set(4000));
  fail_next(Call::pwrite, "/duty_cycle", EIO);
  pwm.reset();
  CHECK_FALSE(kernel.state.enabled);
}

TEST(SysfsPwm, PassesOnWhyADutyWasNotSet) {
  PwmKernel kernel;
  const auto pwm = opened(kernel);
  for (const int error : {EAGAIN, EBUSY, EIO, ENODEV, EINVAL, EREMOTEIO}) {
    fail_next(Call::pwrite, "/duty_cycle", error);
    check_status(status_of(error), pwm->set(1));
  }
  next(Call::pwrite, "/duty_cycle", [] { return 2; });
  check_status(hal::Status::io_error, pwm->set(1000));
  fail_next(Call::pwrite, "/duty_cycle", EINTR, 2);
  check_status(hal::Status::ok, pwm->set(1000));
}

TEST(SysfsPwm, PulsesEnableWithoutEverBeingOn) {
  PwmKernel kernel;
  const auto pwm = opened(kernel);
  kernel.writes.clear();
  check_status(hal::Status::ok, pwm->pulse_enable());
  const std::vector<std::string> expected = {"enable 0", "enable 1"};
  CHECK(kernel.writes == expected);
  CHECK(kernel.state.enabled);
  DOUBLES_EQUAL(0.0, kernel.max_on, 0.0);
  for (const int first : {EIO, 0}) {
    next(Call::pwrite, "/enable", [first] { return first == 0 ? 1 : -first; });
    next(Call::pwrite, "/enable", [first] { return first == 0 ? -EIO : 1; });
    check_status(hal::Status::io_error, pwm->pulse_enable());
  }
}
