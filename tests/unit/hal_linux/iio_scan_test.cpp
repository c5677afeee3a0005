#include "supercoil/hal_linux/iio_scan.hpp"

#include <cerrno>
#include <string>

#include <CppUTest/TestHarness.h>

#include "supercoil/hal_linux/status_of.hpp"

#include "unit/hal_linux/support/scan_tree.hpp"

using namespace supercoil;
using namespace supercoil::hal_linux;
using namespace supercoil::test;

namespace {

/// A scan of voltage0 and voltage2 in the kernel's format: 2 + 2 bytes, 4 of padding, the time.
std::string scan(int voltage0, int voltage2, std::int64_t time_ns) {
  std::string bytes;
  for (const int counts : {voltage0, voltage2}) {
    // be:u12/16>>2, with irrelevant bits around it.
    const int stored = counts << 2 | 0xC003;
    bytes += static_cast<char>(stored >> 8);
    bytes += static_cast<char>(stored & 0xFF);
  }
  bytes += "pad!";
  for (int i = 0; i < 8; ++i)
    bytes += static_cast<char>(time_ns >> (8 * i));
  return bytes;
}

}  // namespace

TEST_GROUP(IioScan) {
  ScanTree board;

  std::unique_ptr<hal_linux::IioScan> opened() const {
    auto scan = hal_linux::IioScan::open(board.place());
    if (!scan) FAIL(scan.error().text().c_str());
    return std::move(*scan);
  }
  /// The device gives these bytes at its next read.
  void arrives(const std::string& bytes) const {
    board.tree.write("dev/iio:device0", bytes);
  }
  static void nothing_new() {
    fail_next(Call::read, "/iio:device0", EAGAIN);
  }
  static void check(hal::Status status, int counts, std::int64_t time_ns, hal::Sample sample) {
    STRCMP_EQUAL(hal::text(status), hal::text(sample.status));
    LONGS_EQUAL(counts, sample.counts);
    LONGS_EQUAL(time_ns, sample.taken.count());
  }
};

TEST(IioScan, EnablesOnlyTheRequestedInputs) {
  const auto scan = opened();
  for (const auto& [name, on] : {std::pair("voltage0", "1\n"),
                                 {"voltage1", "0\n"},
                                 {"voltage2", "1\n"},
                                 {"voltage3", "0\n"},
                                 {"voltage4", "0\n"},
                                 {"timestamp", "1\n"}}) {
    STRCMP_EQUAL(on, board.attribute(std::string("scan_elements/in_") + name + "_en").c_str());
  }
  STRCMP_EQUAL("monotonic\n", board.attribute("current_timestamp_clock").c_str());
  STRCMP_EQUAL("supercoil\n", board.attribute("trigger/current_trigger").c_str());
  STRCMP_EQUAL("64\n", board.attribute("buffer/length").c_str());
}

TEST(IioScan, DisablesTheBufferFirstAndEnablesItLast) {
  const auto scan = opened();
  STRCMP_EQUAL("buffer/enable 0", board.writes.front().c_str());
  STRCMP_EQUAL("buffer/enable 1", board.writes.back().c_str());
}

TEST(IioScan, DisablesTheBufferWhenItEnds) {
  opened().reset();
  STRCMP_EQUAL("buffer/enable 0", board.writes.back().c_str());
}

TEST(IioScan, GivesEachInputItsOwnCountsAndTheTimeOfTheScan) {
  const auto scan_ = opened();
  arrives(scan(111, 4095, 123'456'789'012));
  check(hal::Status::ok, 4095, 123'456'789'012, scan_->input(0).latest());
  nothing_new();
  check(hal::Status::ok, 111, 123'456'789'012, scan_->input(1).latest());
}

TEST(IioScan, TakesTheNewestOfManyScans) {
  const auto scan_ = opened();
  std::string many;
  for (int i = 0; i < 64; ++i)
    many += scan(i, 100 + i, 1000 + i);
  arrives(many);
  check(hal::Status::ok, 163, 1063, scan_->input(0).latest());
}

TEST(IioScan, KeepsAnOldScansTimeWhenNothingNewHasCome) {
  const auto scan_ = opened();
  nothing_new();
  check(hal::Status::not_ready, 0, 0, scan_->input(0).latest());
  arrives(scan(1, 2, 3));
  check(hal::Status::ok, 2, 3, scan_->input(0).latest());
  for (int i = 0; i < 3; ++i) {
    nothing_new();
    check(hal::Status::ok, 2, 3, scan_->input(0).latest());
  }
}

TEST(IioScan, PassesOnWhyThereIsNoneAndKeepsTheLastScan) {
  const auto scan_ = opened();
  arrives(scan(1, 2, 3));
  check(hal::Status::ok, 2, 3, scan_->input(0).latest());
  for (const int error : {EIO, ENODEV, EBUSY}) {
    fail_next(Call::read, "/iio:device0", error);
    check(status_of(error), 2, 3, scan_->input(0).latest());
  }
  arrives("");
  CHECK(scan_->input(0).latest().status == hal::Status::io_error);
}

TEST(IioScan, TreatsAPartialScanAsAnError) {
  const auto scan_ = opened();
  const std::string whole = scan(1, 2, 3);
  for (std::size_t bytes = 1; bytes < whole.size(); ++bytes) {
    const auto again = opened();
    arrives(whole + whole.substr(0, bytes));
    CHECK(again->input(0).latest().status == hal::Status::io_error);
    // None of the scan is used.
    const auto fresh = opened();
    check(hal::Status::io_error, 0, 0, fresh->input(0).latest());
  }
}

TEST(IioScan, BuffersFromTwoToFourThousandScans) {
  for (const int length : {2, 4096}) {
    ScanLocation place = board.place();
    place.length = length;
    CHECK(hal_linux::IioScan::open(place).has_value());
    STRCMP_EQUAL((std::to_string(length) + "\n").c_str(), board.attribute("buffer/length").c_str());
  }
}

TEST(IioScan, BuffersSixtyFourScansByDefault) {
  ScanLocation place = board.place();
  place.length = ScanLocation{}.length;
  const auto scan_ = hal_linux::IioScan::open(place);
  CHECK(scan_.has_value());
  STRCMP_EQUAL("64\n", board.attribute("buffer/length").c_str());
}
