// The reasons why a converter's buffer cannot be set up, in words.
#include <cerrno>
#include <string>

#include <CppUTest/TestHarness.h>

#include "unit/hal_linux/support/scan_tree.hpp"

using namespace supercoil::hal_linux;
using namespace supercoil::test;

TEST_GROUP(IioWrongScan) {
  ScanTree board;

  static std::string answer(const ScanLocation& place) {
    const auto scan = supercoil::hal_linux::IioScan::open(place);
    return scan ? "open" : scan.error().text();
  }
  std::string answer_to(const std::vector<std::string>& inputs) const {
    return answer(board.place(inputs));
  }
};

TEST(IioWrongScan, HasNoInputsOrDuplicateOrUnknownOnes) {
  STRCMP_EQUAL("a scan without inputs", answer_to({}).c_str());
  STRCMP_EQUAL("input 'voltage1' is listed twice", answer_to({"voltage1", "voltage1"}).c_str());
  STRCMP_EQUAL("'../x' is not an input name", answer_to({"../x"}).c_str());
  STRCMP_CONTAINS("in_voltage9_en: No such file or directory", answer_to({"voltage9"}).c_str());
}

TEST(IioWrongScan, HasAnInvalidBufferLength) {
  for (const int length : {-1, 0, 1, 4097}) {
    ScanLocation place = board.place();
    place.length = length;
    STRCMP_CONTAINS("must be 2 to 4096", answer(place).c_str());
  }
}

TEST(IioWrongScan, ListsTheAvailableTriggers) {
  fail_next(Call::pwrite, "/current_trigger", EINVAL);
  STRCMP_CONTAINS("Invalid argument; there are the triggers 'spi0.0-dev0', 'supercoil'",
                  answer(board.place()).c_str());
  board.tree.remove("bus/trigger0");
  board.tree.remove("bus/trigger1");
  fail_next(Call::pwrite, "/current_trigger", EINVAL);
  STRCMP_CONTAINS("there are no triggers at all", answer(board.place()).c_str());
}

TEST(IioWrongScan, NeedsANamedOrPresetTrigger) {
  ScanLocation place = board.place();
  place.trigger.clear();
  STRCMP_CONTAINS("no trigger is named and none is set in ", answer(place).c_str());
  board.tree.write(board.device + "/trigger/current_trigger", "spi0.0-dev0\n");
  STRCMP_EQUAL("open", answer(place).c_str());
}

TEST(IioWrongScan, HasNoTimestamps) {
  board.tree.remove(board.device + "/scan_elements/in_timestamp_en");
  STRCMP_CONTAINS("in_timestamp_en: No such file or directory", answer(board.place()).c_str());
}

TEST(IioWrongScan, CannotUseTheLoopsClock) {
  fail_next(Call::pwrite, "/current_timestamp_clock", EINVAL);
  STRCMP_CONTAINS("cannot write 'monotonic' to ", answer(board.place()).c_str());
}

TEST(IioWrongScan, HasInvalidTypes) {
  board.element("voltage0", 0, "le:s16/16X4>>0", false);
  STRCMP_CONTAINS("'le:s16/16X4>>0' is not a scan type", answer(board.place()).c_str());
  board.element("voltage0", 0, "le:u32/32>>0", false);
  STRCMP_EQUAL("an input of 32 bits: the maximum is 32", answer(board.place()).c_str());
  board.element("voltage0", 0, "le:s32/32>>0", false);
  STRCMP_EQUAL("open", answer(board.place()).c_str());
}

TEST(IioWrongScan, HasInvalidIndexes) {
  board.element("voltage0", 2, "le:s16/16>>0", false);
  STRCMP_EQUAL("two elements of a scan have the same index", answer(board.place()).c_str());
  for (const char* index : {"-1\n", "99999999999\n"}) {
    board.tree.write(board.device + "/scan_elements/in_voltage0_index", index);
    STRCMP_CONTAINS("in_voltage0_index is out of range", answer(board.place()).c_str());
  }
  board.tree.write(board.device + "/scan_elements/in_voltage0_index", "first\n");
  STRCMP_CONTAINS("is not a whole number", answer(board.place()).c_str());
}

TEST(IioWrongScan, IsHeldByAnotherProgram) {
  fail_next(Call::pwrite, "/buffer/enable", EBUSY);
  STRCMP_CONTAINS("buffer/enable: Device or resource busy", answer(board.place()).c_str());
  fail_next(Call::open, "/dev/iio:device0", EBUSY);
  STRCMP_CONTAINS("dev/iio:device0: Device or resource busy", answer(board.place()).c_str());
}

TEST(IioWrongScan, OfADeviceWithoutBuffer) {
  board.tree.remove(board.device + "/buffer");
  STRCMP_CONTAINS("buffer/enable: No such file or directory", answer(board.place()).c_str());
}

TEST(IioWrongScan, CannotBeEnabledOnceItIsSetUp) {
  next(Call::pwrite, "/buffer/enable", [] { return 1; });
  fail_next(Call::pwrite, "/buffer/enable", EINVAL);
  STRCMP_CONTAINS("buffer/enable: Invalid argument", answer(board.place()).c_str());
}
