// Writes and reads lines of candump -L, and refuses other lines.
#include "can_client/candump.hpp"

#include <string>

#include <CppUTest/TestHarness.h>
#include <rapidcheck.h>

#include "unit/firmware/io/can/support/any_frame.hpp"

using namespace supercoil;
using namespace supercoil::can_client;
using namespace supercoil::test;
using namespace std::chrono_literals;

namespace {

/// Empty if the line was read.
std::string error_of(const std::string& line) {
  const auto read = parse_candump_line(line);
  return read ? "" : read.error().text();
}

bool is_ours(const std::string& line) {
  const auto read = parse_candump_line(line);
  CHECK_TEXT(read.has_value(), line.c_str());
  return read->is_standard;
}

}  // namespace

TEST_GROUP(Candump){};

TEST(Candump, WritesWhatCandumpWrites) {
  hal::CanFrame frame;
  frame.id = 0x2C1;
  frame.length = 2;
  frame.data = {0x00, 0xFE};
  STRCMP_EQUAL("(1436509052.249713) can0 2C1#00FE\n",
               candump_line(frame, 1436509052249713us, "can0").c_str());
  frame.id = 1;
  frame.length = 0;
  STRCMP_EQUAL("(0000000000.000000) vcan1 001#\n", candump_line(frame, -1s, "vcan1").c_str());
}

TEST(Candump, TimesOfASimulatedRunCountFromItsStart) {
  CHECK(time_of_run(simulation_epoch) == 0s);
  CHECK(time_of_run(simulation_epoch + 12345678us) == 12345678us);
  CHECK(time_of_run(simulation_epoch + 1'000'000s) == 1'000'000s);
}

TEST(Candump, TimesOfOtherLogsAreKept) {
  for (const hal::Time time :
       {hal::Time{0}, hal::Time{2592000s}, simulation_epoch - 1us, hal::Time{1436509052249713us}})
    CHECK(time_of_run(time) == time);
}

TEST(Candump, EveryFrameRoundTrips) {
  CHECK(rc::check("line and frame", [] {
    hal::CanFrame frame = any_frame();
    const std::int64_t time_us = *rc::gen::inRange<std::int64_t>(0, 4294967295'000000);
    frame.received = std::chrono::microseconds(time_us);
    const auto read = parse_candump_line(candump_line(frame, frame.received, "can0"));
    RC_ASSERT(read.has_value());
    RC_ASSERT(read->is_standard);
    RC_ASSERT(same(read->frame, frame));
  }));
}

TEST(Candump, ReadsOutputOfOtherVersions) {
  const auto read = parse_candump_line("(1.5) slcan7 7ff#deadBEEF R\r\n");
  CHECK(read && read->is_standard);
  LONGS_EQUAL(0x7FF, read->frame.id);
  LONGS_EQUAL(4, read->frame.length);
  LONGS_EQUAL(0xBE, read->frame.data[2]);
  CHECK(read->frame.received == 1500ms);
}

TEST(Candump, IgnoresFramesOfOtherKinds) {
  CHECK_FALSE(is_ours("(1.0) can0 00000281#00"));
  CHECK_FALSE(is_ours("(1.0) can0 1FFFFFFF#0011223344556677"));
  CHECK_FALSE(is_ours("(1.0) can0 20000080#0000000000000000"));
  CHECK_FALSE(is_ours("(1.0) can0 800#00"));
  CHECK_FALSE(is_ours("(1.0) can0 281#R"));
  CHECK_FALSE(is_ours("(1.0) can0 281#R8"));
  CHECK_FALSE(is_ours("(1.0) can0 281##1" + std::string(128, 'A')));
}

TEST(Candump, AnInvalidLineIsReported) {
  for (const char* line :
       {"", "\n", "can0 281#00", "1.0 can0 281#00", "() can0 281#00", "(1) can0 281#00",
        "(1.) can0 281#00", "(.5) can0 281#00", "(-1.0) can0 281#00", "(1.x) can0 281#00",
        "(1.0 can0 281#00", "(99999999999999999999.0) can0 281#00", "(4294967296.0) can0 281#00"}) {
    CHECK_TEXT(error_of(line).find("SECONDS") != std::string::npos, line);
  }
  for (const char* line : {"(1.0)", "(1.0) can0", "(1.0) can0 281", "(1.0) 281#00"})
    CHECK_TEXT(error_of(line).find("ID#DATA") != std::string::npos, line);
  for (const char* line :
       {"(1.0) can0 #00", "(1.0) can0 81#00", "(1.0) can0 0281#00", "(1.0) can0 28G#00",
        "(1.0) can0 -81#00", "(1.0) can0 0x1#00", "(1.0) can0 1FFFFFFFF#00"}) {
    CHECK_TEXT(error_of(line).find("identifier") != std::string::npos, line);
  }
  for (const char* line : {"(1.0) can0 281#0", "(1.0) can0 281#0G", "(1.0) can0 281#-1",
                           "(1.0) can0 281#001122334455667788", "(1.0) can0 281#00#11"}) {
    CHECK_TEXT(error_of(line).find("data must") != std::string::npos, line);
  }
}

/// Whatever the bytes are, reading ends and stays within them (AddressSanitizer watches).
TEST(Candump, AnyChangedLineIsReadOrRefused) {
  CHECK(rc::check("changed lines", [] {
    std::string line = candump_line(any_frame(), 1436509052249713us, "can0");
    const auto at = *rc::gen::inRange<std::size_t>(0, line.size());
    line[at] = *rc::gen::arbitrary<char>();
    line.resize(*rc::gen::inRange<std::size_t>(0, line.size() + 1));
    const auto read = parse_candump_line(line);
    // RC_ASSERT evaluates both sides of its own ||.
    const bool within = !read || (read->frame.length <= 8 && read->frame.id < 0x800);
    RC_ASSERT(within);
  }));
}
