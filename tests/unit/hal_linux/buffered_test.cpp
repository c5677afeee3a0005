// Devices behind a bus, served by hand.
#include <string>

#include <CppUTest/TestHarness.h>

#include "supercoil/hal_linux/buffered_adc.hpp"
#include "supercoil/hal_linux/buffered_pwm.hpp"

#include "unit/hal_linux/support/fakes.hpp"

using namespace supercoil;
using namespace supercoil::hal_linux;
using namespace supercoil::test;

namespace {

void check_status(hal::Status expected, hal::Status status) {
  STRCMP_EQUAL(hal::text(expected), hal::text(status));
}

void check_sample(hal::Status status, int counts, hal::Sample sample) {
  check_status(status, sample.status);
  LONGS_EQUAL(counts, sample.counts);
  LONGS_EQUAL(counts, sample.taken.count());
}

}  // namespace

TEST_GROUP(BufferedAdc) {
  FakeAdc* device = new FakeAdc;
  hal_linux::BufferedAdc adc{std::unique_ptr<hal::AdcChannel>(device)};
};

TEST(BufferedAdc, HasNothingBeforeItIsServed) {
  check_sample(hal::Status::not_ready, 0, adc.latest());
  LONGS_EQUAL(0, device->reads);
}

TEST(BufferedAdc, RepeatsTheNewestConversionWithItsOwnTime) {
  adc.serve();
  adc.serve();
  for (int i = 0; i < 3; ++i)
    check_sample(hal::Status::ok, 2, adc.latest());
}

TEST(BufferedAdc, ReportsAFailureWithTheLastGoodConversion) {
  adc.serve();
  for (const auto status : {hal::Status::io_error, hal::Status::gone, hal::Status::busy}) {
    device->status = status;
    adc.serve();
    check_sample(status, 1, adc.latest());
  }
  device->status = hal::Status::ok;
  adc.serve();
  check_sample(hal::Status::ok, 5, adc.latest());
}

TEST(BufferedAdc, LetsTheLastConversionAgeWhileTheDeviceHasNoNewOne) {
  adc.serve();
  device->status = hal::Status::not_ready;
  adc.serve();
  check_sample(hal::Status::ok, 1, adc.latest());
}

TEST_GROUP(BufferedPwm) {
  FakePwm* device = new FakePwm;
  hal_linux::BufferedPwm pwm{std::unique_ptr<hal::PwmOutput>(device)};
};

TEST(BufferedPwm, WritesNothingBeforeItIsSet) {
  pwm.serve();
  LONGS_EQUAL(0, device->writes);
  LONGS_EQUAL(1000, pwm.steps());
}

TEST(BufferedPwm, WritesTheNewestStepOnce) {
  for (const int step : {1, 2, 3})
    check_status(hal::Status::ok, pwm.set(step));
  pwm.serve();
  pwm.serve();
  LONGS_EQUAL(1, device->writes);
  LONGS_EQUAL(3, device->written);
}

TEST(BufferedPwm, ReadsNothingBackWhileAWriteIsUnderWay) {
  LONGS_EQUAL(-1, pwm.read_back());
  check_status(hal::Status::ok, pwm.set(500));
  LONGS_EQUAL(-1, pwm.read_back());
  pwm.serve();
  LONGS_EQUAL(500, pwm.read_back());
  // The same step is written again.
  check_status(hal::Status::ok, pwm.set(500));
  LONGS_EQUAL(-1, pwm.read_back());
}

TEST(BufferedPwm, RefusesAStepOutOfRange) {
  check_status(hal::Status::ok, pwm.set(500));
  pwm.serve();
  for (const int step : {-1, 1001})
    check_status(hal::Status::out_of_range, pwm.set(step));
  pwm.serve();
  LONGS_EQUAL(500, device->written);
  LONGS_EQUAL(500, pwm.read_back());
}

TEST(BufferedPwm, ReportsAFailureAtTheNextSetAndRetries) {
  device->status = hal::Status::gone;
  check_status(hal::Status::ok, pwm.set(500));
  pwm.serve();
  LONGS_EQUAL(-1, pwm.read_back());
  check_status(hal::Status::gone, pwm.set(0));
  pwm.serve();
  pwm.serve();
  LONGS_EQUAL(3, device->writes);
  device->status = hal::Status::ok;
  pwm.serve();
  LONGS_EQUAL(0, device->written);
  LONGS_EQUAL(0, pwm.read_back());
  check_status(hal::Status::ok, pwm.set(0));
}

TEST(BufferedPwm, ReportsAStallAsBusy) {
  pwm.serve();
  for (int i = 0; i < hal_linux::BufferedPwm::max_unserved; ++i) {
    check_status(hal::Status::ok, pwm.set(1));
  }
  check_status(hal::Status::busy, pwm.set(1));
  check_status(hal::Status::busy, pwm.set(1));
  pwm.serve();
  check_status(hal::Status::ok, pwm.set(1));
}
