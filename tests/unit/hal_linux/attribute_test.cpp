#include "supercoil/hal_linux/attribute.hpp"

#include <cerrno>
#include <cstdint>
#include <limits>
#include <string>

#include <CppUTest/TestHarness.h>
#include <rapidcheck.h>

#include "supercoil/hal_linux/status_of.hpp"

#include "unit/hal_linux/support/check_status.hpp"
#include "unit/hal_linux/support/system_calls.hpp"
#include "unit/hal_linux/support/temporary_folder.hpp"

using namespace supercoil;
using namespace supercoil::hal_linux;
using namespace supercoil::test;

namespace {

/// Contents of a file that are not a number.
const auto no_numbers = {
    std::string(),
    std::string("\n"),
    std::string("abc"),
    std::string("12 34"),
    std::string("1\n2\n"),
    std::string(" 1"),
    std::string("1 "),
    std::string("+1"),
    std::string("0x10"),
    std::string("1.5"),
    std::string("1\0", 2),
    std::string("\0", 1),
    std::string("\xff\xfe"),
    std::string("--1"),
    std::string("-"),
    std::string("9223372036854775808"),
    std::string("-9223372036854775809"),
    std::string(31, '1'),
    std::string(32, '0'),
    std::string(5000, '7'),
    std::string("99999999999999999999999999999"),
    std::string("1\n\n"),
};

}  // namespace

TEST_GROUP(Attribute) {
  TemporaryFolder folder;
  void teardown() override {
    reset_calls();
  }
  hal_linux::Attribute opened(const std::string& content,
                              hal_linux::Attribute::Use use = hal_linux::Attribute::Use::both)
      const {
    folder.write("value", content);
    auto attribute = hal_linux::Attribute::open(folder / "value", use);
    CHECK(attribute.has_value());
    return std::move(*attribute);
  }
};

TEST(Attribute, ReadsEveryWholeNumber) {
  CHECK(rc::check("numbers come back", [](std::int64_t value, bool newline) {
    const Number number = parse_number(std::to_string(value) + (newline ? "\n" : ""));
    RC_ASSERT(number.status == hal::Status::ok);
    RC_ASSERT(number.value == value);
  }));
}

TEST(Attribute, ReadsNothingElseAsANumber) {
  const auto attribute = opened("1");
  for (const std::string& content : no_numbers) {
    folder.write("value", content);
    check_status(hal::Status::io_error, attribute.number().status);
    LONGS_EQUAL(0, attribute.number().value);
  }
}

TEST(Attribute, ParsesOnlyNumbersFromArbitraryText) {
  CHECK(rc::check("random text", [](const std::string& text) {
    const Number number = parse_number(text);
    if (number.status == hal::Status::ok) {
      RC_ASSERT(!text.empty());
      RC_ASSERT(text.find_first_not_of("-0123456789\n") == std::string::npos);
    }
  }));
}

TEST(Attribute, ReadsANewValueThroughTheSameDescriptor) {
  const auto attribute = opened("1\n", hal_linux::Attribute::Use::read);
  LONGS_EQUAL(1, attribute.number().value);
  folder.write("value", "-31000\n");
  LONGS_EQUAL(-31000, attribute.number().value);
}

TEST(Attribute, WritesNumbersInTheKernelsFormat) {
  const auto attribute = opened("");
  check_status(hal::Status::ok, attribute.write(std::numeric_limits<std::int64_t>::min()));
  STRCMP_EQUAL("-9223372036854775808", folder.read("value").c_str());
}

TEST(Attribute, PassesOnWhyItCouldNotBeReadOrWritten) {
  const auto attribute = opened("1");
  for (const int error : {EAGAIN, EBUSY, EIO, ENODEV, EINVAL}) {
    fail_next(Call::pread, "/value", error);
    check_status(status_of(error), attribute.number().status);
    fail_next(Call::pwrite, "/value", error);
    check_status(status_of(error), attribute.write(7));
  }
}

TEST(Attribute, SetUpErrorsNamePathValueAndCause) {
  const auto attribute = opened("1");
  fail_next(Call::pwrite, "/value", EINVAL);
  const std::string path = folder / "value";
  STRCMP_EQUAL(("cannot write '0' to " + path + ": Invalid argument").c_str(),
               attribute.set("0").error().text().c_str());
  next(Call::pwrite, "/value", [] { return 1; });
  STRCMP_EQUAL(("cannot write '100' to " + path + ": only part was accepted").c_str(),
               attribute.set("100").error().text().c_str());
  fail_next(Call::pread, "/value", EIO);
  STRCMP_EQUAL(("cannot read " + path + ": Input/output error").c_str(),
               attribute.text().error().text().c_str());
  folder.write("value", "many words, more than anybody wants to read here\n");
  STRCMP_EQUAL((path + " holds 'many words, more than anybody wants to r'…, "
                       "which is not a whole number")
                   .c_str(),
               attribute.integer().error().text().c_str());
}

TEST(Attribute, RefusesBinaryContent) {
  const auto attribute = opened("");
  STRCMP_CONTAINS("is empty", attribute.text().error().text().c_str());
  folder.write("value", std::string("\x7f"
                                    "ELF\0\1",
                                    6));
  STRCMP_CONTAINS("is not text", attribute.text().error().text().c_str());
  folder.write("value", std::string(4096, 'a'));
  LONGS_EQUAL(4096, attribute.text()->size());
  folder.write("value", std::string(4097, 'a'));
  STRCMP_CONTAINS("is longer than a page", attribute.text().error().text().c_str());
}

TEST(Attribute, DoesNotBlockOnAPipeInItsPlace) {
  folder.make_pipe("pipe");
  // Without a reader, a pipe refuses a writer with ENXIO; with one it turns out not to be a file.
  for (const auto use : {hal_linux::Attribute::Use::read, hal_linux::Attribute::Use::write,
                         hal_linux::Attribute::Use::both}) {
    CHECK_FALSE(hal_linux::Attribute::open(folder / "pipe", use).has_value());
  }
}

TEST(Attribute, RefusesAFolderInItsPlace) {
  folder.make_folder("folder");
  STRCMP_EQUAL((folder / "folder" + " is not a file").c_str(),
               read_text(folder / "folder").error().text().c_str());
  LONGS_EQUAL(EISDIR, write_text(folder / "folder", "1").error().code);
}
