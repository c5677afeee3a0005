#include "supercoil/hal_linux/iio_adc.hpp"

#include <cerrno>
#include <cstdint>
#include <string>

#include <CppUTest/TestHarness.h>

#include "supercoil/hal_linux/monotonic_clock.hpp"
#include "supercoil/hal_linux/status_of.hpp"

#include "unit/hal_linux/support/system_calls.hpp"
#include "unit/hal_linux/support/temporary_folder.hpp"

using namespace supercoil;
using namespace supercoil::hal_linux;
using namespace supercoil::test;

TEST_GROUP(IioAdc) {
  TemporaryFolder tree;
  const std::string at_48 = "devices/i2c-1/1-0048/iio:device0";
  const std::string at_49 = "devices/i2c-1/1-0049/iio:device1";
  const std::string raw = at_48 + "/in_voltage0_raw";

  void setup() override {
    for (const std::string& device : {at_48, at_49}) {
      tree.write(device + "/name", "ads1115\n");
      tree.write(device + "/in_voltage0_raw", "-1234\n");
      tree.write(device + "/in_voltage0-voltage1_raw", "5\n");
      tree.link("bus/" + device.substr(device.rfind('/') + 1), device);
    }
    tree.make_folder("bus/trigger0");
  }
  void teardown() override {
    reset_calls();
  }

  ConverterLocation place(const std::string& input = "voltage0") const {
    return {"i2c-1/1-0048", input, tree / "bus"};
  }
  std::string answer(const ConverterLocation& where) const {
    const auto adc = hal_linux::IioAdc::open(where);
    return adc ? "open" : adc.error().text();
  }
  std::unique_ptr<hal_linux::IioAdc> opened() const {
    auto adc = hal_linux::IioAdc::open(place());
    if (!adc) FAIL(adc.error().text().c_str());
    return std::move(*adc);
  }
  void check_latest(hal::Status expected) const {
    STRCMP_EQUAL(hal::text(expected), hal::text(opened()->latest().status));
  }
};

TEST(IioAdc, ReturnsCountsAndTheTimeBeforeTheConversion) {
  const auto adc = opened();
  const hal::Time before = MonotonicClock::time();
  const hal::Sample sample = adc->latest();
  CHECK(sample.status == hal::Status::ok);
  LONGS_EQUAL(-1234, sample.counts);
  CHECK(sample.taken >= before && sample.taken <= MonotonicClock::time());
}

TEST(IioAdc, ReadsDifferentialInputs) {
  const auto adc = hal_linux::IioAdc::open(place("voltage0-voltage1"));
  LONGS_EQUAL(5, (*adc)->latest().counts);
}

TEST(IioAdc, ReadsEachNewValue) {
  const auto adc = opened();
  for (const std::int32_t counts : {0, 32767, -32768, INT32_MAX, INT32_MIN}) {
    tree.write(raw, std::to_string(counts) + "\n");
    LONGS_EQUAL(counts, adc->latest().counts);
  }
}

TEST(IioAdc, RefusesAnAmbiguousName) {
  ConverterLocation where = place();
  where.device = "ads1115";
  STRCMP_EQUAL(("more than one converter with the name 'ads1115' in " + tree / "bus" +
                ": iio:device0 'ads1115' at " + tree / "devices/i2c-1/1-0048" +
                ", iio:device1 'ads1115' at " + tree / "devices/i2c-1/1-0049" +
                "; say which by the end of its path")
                   .c_str(),
               answer(where).c_str());
}

TEST(IioAdc, ListsTheAvailableInputs) {
  STRCMP_EQUAL(("no input 'voltage7' on iio:device0 'ads1115' at " + tree / "devices/i2c-1/1-0048" +
                ": there are voltage0, voltage0-voltage1")
                   .c_str(),
               answer(place("voltage7")).c_str());
  STRCMP_EQUAL("'../../etc/x' is not an input name", answer(place("../../etc/x")).c_str());
  STRCMP_EQUAL("'' is not an input name", answer(place("")).c_str());
}

TEST(IioAdc, IsRefusedWhenItDoesNotRespondAtOnce) {
  fail_next(Call::pread, "_raw", EREMOTEIO);
  STRCMP_CONTAINS("in_voltage0_raw: Remote I/O error", answer(place()).c_str());
  tree.write(raw, "nothing\n");
  STRCMP_CONTAINS("holds 'nothing', which is not a whole number", answer(place()).c_str());
}

TEST(IioAdc, PassesOnWhyThereIsNoValue) {
  const auto adc = opened();
  for (const int error : {EAGAIN, EBUSY, EIO, ENODEV, ETIMEDOUT, EREMOTEIO}) {
    fail_next(Call::pread, "_raw", error);
    STRCMP_EQUAL(hal::text(status_of(error)), hal::text(adc->latest().status));
  }
  fail_next(Call::pread, "_raw", EINTR, 2);
  CHECK(adc->latest().status == hal::Status::ok);
}

TEST(IioAdc, TreatsInvalidTextAsAnError) {
  const auto adc = opened();
  for (const std::string& content :
       {std::string(), std::string("\n"), std::string("abc"), std::string("2147483648\n"),
        std::string("-2147483649\n"), std::string("1.5\n"), std::string("\0\x01", 2),
        std::string(4096, '9')}) {
    tree.write(raw, content);
    CHECK(adc->latest().status == hal::Status::io_error);
  }
}

TEST(IioAdc, DoesNotBlockOnAPipeOrAFolder) {
  tree.remove(raw);
  tree.make_pipe(raw);
  STRCMP_CONTAINS("is not a file", answer(place()).c_str());
  tree.remove(raw);
  tree.make_folder(raw);
  STRCMP_CONTAINS("is not a file", answer(place()).c_str());
}

TEST(IioAdc, ReportsTheRangeOfItsCounts) {
  const std::string type = at_48 + "/scan_elements/in_voltage0_type";
  CHECK_FALSE(count_range(place()).has_value());
  tree.write(type, "be:s16/16>>0\n");
  LONGS_EQUAL(-32768, count_range(place())->min);
  LONGS_EQUAL(32767, count_range(place())->max);
  tree.write(type, "be:u12/16>>2\n");
  LONGS_EQUAL(0, count_range(place())->min);
  LONGS_EQUAL(4095, count_range(place())->max);
  tree.write(type, "be:u32/32>>0\n");
  CHECK(count_range(place())->max == 0xFFFFFFFF);
  tree.write(type, "be:u33/64>>0\n");
  CHECK_FALSE(count_range(place()).has_value());
  tree.write(type, "12 bits\n");
  CHECK_FALSE(count_range(place()).has_value());
  CHECK_FALSE(count_range(place("../voltage0")).has_value());
  CHECK_FALSE(count_range({"i2c-1/1-0050", "voltage0", tree / "bus"}).has_value());
}

TEST(IioAdc, GivesNoCountsWithAFailure) {
  const auto adc = opened();
  fail_next(Call::pread, "_raw", EIO);
  LONGS_EQUAL(0, adc->latest().counts);
  tree.write(raw, "2147483648\n");
  LONGS_EQUAL(0, adc->latest().counts);
}

TEST(IioAdc, ReportsThatThereAreNoConverters) {
  ConverterLocation where = place();
  where.root = "/nowhere";
  STRCMP_EQUAL("cannot list /nowhere: No such file or directory", answer(where).c_str());
  CHECK_FALSE(count_range(where).has_value());
}
